// From a client's request_id to what the catalog keeps of the request.
#ifndef ARGMESH_SERVER_ENGINE_REQUEST_STAMP_H_
#define ARGMESH_SERVER_ENGINE_REQUEST_STAMP_H_

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "server/engine/catalog_requests.h"
#include "server/engine/shape_requests.h"

namespace argmesh {

// `fields` is everything the request asks for, in a fixed order: two requests
// are the same when their methods and fields are.
//
// Fails    kInvalidArgument FIELD_INVALID  the request_id is no UUID
absl::StatusOr<RequestStamp> StampRequest(
    const RequestKey& key, std::string_view method,
    const std::vector<std::string>& fields, absl::Time expire_time);

// Key after key with its value.
void AddFields(const std::map<std::string, std::string>& metadata,
               std::vector<std::string>& fields);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_REQUEST_STAMP_H_
