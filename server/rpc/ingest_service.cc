#include "server/rpc/ingest_service.h"

#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"
#include "server/rpc/convert_run.h"
#include "server/rpc/convert_shape.h"
#include "server/rpc/ingest_reactor.h"
#include "server/rpc/resource_name.h"
#include "server/rpc/unary_reactor.h"

namespace argmesh {
namespace {

constexpr char kImportMethod[] = "IngestService.ImportShapes";

absl::Status StartImport(ServiceEnvironment& environment,
                         const v1::ImportShapesRequest& request,
                         google::longrunning::Operation* response) {
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

grpc::ServerBidiReactor<v1::IngestShapesRequest, v1::IngestShapesResponse>*
IngestServiceImpl::IngestShapes(grpc::CallbackServerContext* context) {
  return StartReactor<IngestReactor>(environment_, context);
}

grpc::ServerUnaryReactor* IngestServiceImpl::ImportShapes(
    grpc::CallbackServerContext* context,
    const v1::ImportShapesRequest* request,
    google::longrunning::Operation* response) {
  return UnaryReactor::Start(
      environment_, context, {request, response}, {kImportMethod},
      [this, request, response](const UnaryCall&) {
        return StartImport(environment_, *request, response);
      });
}

}  // namespace argmesh
