#include "server/rpc/stream_search_reactor.h"

#include <utility>
#include <variant>

#include "core/base/status_macros.h"
#include "server/rpc/convert_match.h"
#include "server/rpc/measured_search.h"

namespace argmesh {

StreamSearchReactor::StreamSearchReactor(ServiceEnvironment& environment,
                                         grpc::CallbackServerContext* context)
    : WritingReactor(
          environment, context,
          MeshStreamPlan{"SearchService.StreamSearchShapes", WorkClass::kSearch,
                         environment.query_streams, &environment.searches}) {}

void StreamSearchReactor::OnOverBudget() { scope().context()->TryCancel(); }

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
  ARGMESH_ASSIGN_OR_RETURN(const SearchAnswer answer,
                           MeasuredSearch(environment(), query_, stop()));
  query_ = {};
  Prepare(answer);
  // Who takes the answer slowly takes no place of a search meanwhile.
  ReleasePlace();
  SendNext();
  return absl::OkStatus();
}

void StreamSearchReactor::Prepare(const SearchAnswer& answer) {
  *messages_.emplace_back().mutable_query() = QueryToProto(answer, form_);
  for (const SearchMatch& match : answer.matches) {
    *messages_.emplace_back().mutable_match() = ToProto(match, form_);
  }
  *messages_.emplace_back().mutable_stats() = ToProto(answer.stats);
  int64_t bytes = 0;
  for (const v1::StreamSearchShapesResponse& message : messages_) {
    bytes += static_cast<int64_t>(message.ByteSizeLong());
  }
  holdings().Hold(environment().answers, bytes);
}

absl::StatusOr<bool> StreamSearchReactor::Continue(
    v1::StreamSearchShapesResponse& next) {
  if (messages_.empty()) return false;
  next = std::move(messages_.front());
  messages_.pop_front();
  return true;
}

}  // namespace argmesh
