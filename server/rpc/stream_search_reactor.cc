#include "server/rpc/stream_search_reactor.h"

#include <utility>
#include <variant>

#include "core/base/status_macros.h"
#include "server/rpc/convert_match.h"

namespace argmesh {

StreamSearchReactor::StreamSearchReactor(ServiceEnvironment& environment,
                                         grpc::CallbackServerContext* context)
    : WritingReactor(environment, context,
                     MeshStreamPlan{"SearchService.StreamSearchShapes",
                                    WorkClass::kSearch, environment.searches}) {
}

absl::StatusOr<UploadAnnouncement> StreamSearchReactor::Announced(
    const v1::StreamSearchShapesRequest& first) {
  ARGMESH_ASSIGN_OR_RETURN(AnnouncedSearch announced,
                           FromProto(first.header()));
  // Before gigabytes come for a collection that is not there.
  ARGMESH_RETURN_IF_ERROR(
      engine().GetCollection(announced.query.collection).status());
  query_ = std::move(announced.query);
  const v1::SearchShapesRequest& search = first.header().search();
  form_ = {.mode = query_.mode,
           .explain = search.explain(),
           .query_graph = search.return_query_graph(),
           .max_bytes = kMaxAnswerBytes};
  return announced.upload;
}

absl::Status StreamSearchReactor::Take(std::unique_ptr<StagedMesh> mesh) {
  ARGMESH_ASSIGN_OR_RETURN(std::get<MeshBytes>(query_.query).bytes,
                           mesh->ReadAll());
  mesh.reset();
  ARGMESH_ASSIGN_OR_RETURN(answer_, engine().Search(query_, stop()));
  query_ = {};
  SendNext();
  return absl::OkStatus();
}

absl::StatusOr<bool> StreamSearchReactor::Continue(
    v1::StreamSearchShapesResponse& next) {
  const size_t at = sent_++;
  const size_t matches = answer_.matches.size();
  if (at == 0) {
    *next.mutable_query() = QueryToProto(answer_, form_);
  } else if (at <= matches) {
    *next.mutable_match() = ToProto(answer_.matches[at - 1], form_);
  } else if (at == matches + 1) {
    *next.mutable_stats() = ToProto(answer_.stats);
  }
  return at <= matches + 1;
}

}  // namespace argmesh
