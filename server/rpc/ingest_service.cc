#include "server/rpc/ingest_service.h"

#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"
#include "server/rpc/convert_run.h"
#include "server/rpc/convert_shape.h"
#include "server/rpc/ingest_reactor.h"
#include "server/rpc/resource_name.h"

namespace argmesh {
namespace {

constexpr char kImportMethod[] = "IngestService.ImportShapes";

absl::Status ImportShapes(const UnaryCall& call,
                          const v1::ImportShapesRequest& request,
                          google::longrunning::Operation* response) {
  ServiceEnvironment& environment = call.environment;
  FolderImport folder;
  ARGMESH_ASSIGN_OR_RETURN(folder.collection,
                           ParseCollectionName("parent", request.parent()));
  folder.folder = request.folder();
  ARGMESH_ASSIGN_OR_RETURN(
      folder.if_exists,
      FromProto("existing_shape_policy", request.existing_shape_policy()));
  if (environment.import_source == nullptr) {
    return MakeError(ErrorReason::kImportNotEnabled,
                     "the server has no --import-root");
  }
  Engine& engine = environment.engine;
  ARGMESH_RETURN_IF_ERROR(engine.GetCollection(folder.collection).status());
  const auto work =
      [&engine, folder, &source = *environment.import_source](
          const RunControl& control) -> absl::StatusOr<google::protobuf::Any> {
    ARGMESH_ASSIGN_OR_RETURN(const RunReport report,
                             engine.Import(folder, source, control));
    return Packed(ImportAnswer(report));
  };
  ARGMESH_ASSIGN_OR_RETURN(
      *response,
      environment.operations.Start(kImportMethod, request.parent(), work));
  return absl::OkStatus();
}

}  // namespace

IngestServiceImpl::IngestServiceImpl(ServiceEnvironment& environment)
    : RpcService(environment) {
  Stream<IngestReactor>("IngestService.IngestShapes");
  Unary({kImportMethod}, ImportShapes);
}

}  // namespace argmesh
