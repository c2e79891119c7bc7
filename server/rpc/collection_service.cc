#include "server/rpc/collection_service.h"

#include <optional>
#include <utility>

#include "core/base/status_macros.h"
#include "server/rpc/convert_collection.h"
#include "server/rpc/convert_run.h"
#include "server/rpc/convert_update.h"
#include "server/rpc/resource_name.h"
#include "server/rpc/status.h"

namespace argmesh {
namespace {

constexpr char kReindex[] = "CollectionService.ReindexCollection";

absl::Status CreateCollection(const UnaryCall& call,
                              const v1::CreateCollectionRequest& request,
                              v1::Collection* response) {
  NewCollection spec;
  ARGMESH_RETURN_IF_ERROR(
      CheckResourceId("collection_id", request.collection_id()));
  spec.id = request.collection_id();
  spec.display_name = request.collection().display_name();
  ARGMESH_ASSIGN_OR_RETURN(
      spec.settings,
      FromProto("collection.settings", request.collection().settings()));
  ARGMESH_ASSIGN_OR_RETURN(spec.metadata_keys,
                           FromProto("collection.metadata_keys",
                                     request.collection().metadata_keys()));
  spec.request = {call.caller.principal, request.request_id()};
  ARGMESH_ASSIGN_OR_RETURN(const CollectionRecord record,
                           call.environment.engine.CreateCollection(spec));
  *response = ToProto(record);
  return absl::OkStatus();
}

absl::Status GetCollection(const UnaryCall& call,
                           const v1::GetCollectionRequest& request,
                           v1::Collection* response) {
  ARGMESH_ASSIGN_OR_RETURN(const std::string id,
                           ParseCollectionName("name", request.name()));
  ARGMESH_ASSIGN_OR_RETURN(const CollectionRecord record,
                           call.environment.engine.GetCollection(id));
  *response = ToProto(record);
  return absl::OkStatus();
}

absl::Status ListCollections(const UnaryCall& call,
                             const v1::ListCollectionsRequest& request,
                             v1::ListCollectionsResponse* response) {
  ARGMESH_ASSIGN_OR_RETURN(const CollectionPage page,
                           call.environment.engine.ListCollections(
                               {.page_size = request.page_size(),
                                .page_token = request.page_token(),
                                .max_bytes = kMaxAnswerBytes}));
  for (const CollectionRecord& record : page.collections) {
    // A page may hold fewer than asked for, even none.
    if (!call.caller.Covers(record.id)) continue;
    *response->add_collections() = ToProto(record);
  }
  response->set_next_page_token(page.next_page_token);
  return absl::OkStatus();
}

absl::Status UpdateCollection(const UnaryCall& call,
                              const v1::UpdateCollectionRequest& request,
                              v1::Collection* response) {
  ARGMESH_ASSIGN_OR_RETURN(CollectionPatch patch, FromProto(request));
  ARGMESH_ASSIGN_OR_RETURN(
      const CollectionRecord record,
      call.environment.engine.UpdateCollection(
          std::move(patch), {call.caller.principal, request.request_id()}));
  *response = ToProto(record);
  return absl::OkStatus();
}

absl::Status DeleteCollection(const UnaryCall& call,
                              const v1::DeleteCollectionRequest& request,
                              v1::DeleteCollectionResponse*) {
  ARGMESH_ASSIGN_OR_RETURN(const std::string id,
                           ParseCollectionName("name", request.name()));
  return call.environment.engine.DeleteCollection(
      {.id = id, .force = request.force(), .etag = request.etag()},
      {call.caller.principal, request.request_id()});
}

absl::Status ReindexCollection(const UnaryCall& call,
                               const v1::ReindexCollectionRequest& request,
                               google::longrunning::Operation* response) {
  ARGMESH_ASSIGN_OR_RETURN(const std::string id,
                           ParseCollectionName("name", request.name()));
  Engine& engine = call.environment.engine;
  std::optional<CollectionSettings> settings;
  if (request.has_settings()) {
    ARGMESH_ASSIGN_OR_RETURN(const CollectionRecord present,
                             engine.GetCollection(id));
    ARGMESH_ASSIGN_OR_RETURN(
        settings, FromProto("settings", request.settings(), present.settings));
  }
  ARGMESH_RETURN_IF_ERROR(engine.CheckReindex(id, settings));
  const auto work =
      [&engine, id, settings](
          const RunControl& control) -> absl::StatusOr<google::protobuf::Any> {
    ARGMESH_ASSIGN_OR_RETURN(const ReindexReport report,
                             engine.Reindex(id, settings, control));
    return Packed(ReindexAnswer(report));
  };
  ARGMESH_ASSIGN_OR_RETURN(*response, call.environment.operations.Start(
                                          kReindex, request.name(), work));
  return absl::OkStatus();
}

}  // namespace

CollectionServiceImpl::CollectionServiceImpl(ServiceEnvironment& environment)
    : RpcService(environment) {
  Unary({"CollectionService.CreateCollection"}, CreateCollection);
  Unary({"CollectionService.GetCollection"}, GetCollection);
  Unary({"CollectionService.ListCollections"}, ListCollections);
  Unary({"CollectionService.UpdateCollection"}, UpdateCollection);
  Unary({"CollectionService.DeleteCollection"}, DeleteCollection);
  Unary({kReindex}, ReindexCollection);
}

}  // namespace argmesh
