// argmesh/v1/search_service.proto to and from the engine's types.
#ifndef ARGMESH_SERVER_RPC_CONVERT_SEARCH_H_
#define ARGMESH_SERVER_RPC_CONVERT_SEARCH_H_

#include <cstdint>

#include "absl/status/statusor.h"
#include "argmesh/v1/search_service.pb.h"
#include "server/engine/mesh_upload.h"
#include "server/engine/search_requests.h"

namespace argmesh {

// FIELD_INVALID, FIELD_REQUIRED, NAME_INVALID, GRAPH_INVALID,
// GRAPH_VERSION_MISMATCH.
absl::StatusOr<SearchQuery> FromProto(const v1::SearchShapesRequest& request);

// The query is a MeshBytes without its bytes. As above.
struct AnnouncedSearch {
  SearchQuery query;
  UploadAnnouncement upload;
};
absl::StatusOr<AnnouncedSearch> FromProto(
    const v1::StreamSearchShapesHeader& header);

// As above.
absl::StatusOr<CompareQuery> FromProto(const v1::CompareShapesRequest& request);

// What goes into an answer.
struct SearchAnswerForm {
  MatchMode mode = MatchMode::kGlobal;
  bool explain = false;
  bool query_graph = false;  // when the answer has one
  int64_t max_bytes = 0;
};

// Face labels that take more than half of `max_bytes` are left out; so are,
// the worst first, matches that would pass it, and `truncated` says so.
v1::SearchShapesResponse ToProto(const SearchAnswer& answer,
                                 const SearchAnswerForm& form);

// The query alone, and one match alone.
v1::StreamedQuery QueryToProto(const SearchAnswer& answer,
                               const SearchAnswerForm& form);
v1::Match ToProto(const SearchMatch& found, const SearchAnswerForm& form);

// Without the target's shape.
v1::CompareShapesResponse ToProto(const ComparedShapes& compared,
                                  const SearchAnswerForm& form);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_CONVERT_SEARCH_H_
