// The opaque text that says where the next page of a list begins.
//
// Holds what the list was of, so that it is refused for any other.
// Fails    kInvalidArgument PAGE_TOKEN_INVALID
#ifndef ARGMESH_SERVER_ENGINE_PAGE_TOKEN_H_
#define ARGMESH_SERVER_ENGINE_PAGE_TOKEN_H_

#include <string>
#include <string_view>

#include "absl/status/statusor.h"

namespace argmesh {

// `list` names the list, such as "shapes/cups"; the page begins after the item
// with the id `last_id`. ASCII.
std::string MakePageToken(std::string_view list, std::string_view last_id);

// The `last_id`; empty for an empty token.
absl::StatusOr<std::string> ParsePageToken(std::string_view list,
                                           std::string_view token);

// FIELD_INVALID when negative; 100 for 0, at most 1000.
absl::StatusOr<int> CheckPageSize(int page_size);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_PAGE_TOKEN_H_
