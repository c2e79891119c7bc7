// Ids that let the server recognise a repeated request.
#ifndef ARGMESH_CLIENT_REQUEST_ID_H_
#define ARGMESH_CLIENT_REQUEST_ID_H_

#include <string>

namespace argmesh {

// A random UUID (RFC 4122, version 4) from the system's entropy.
std::string NewRequestId();

// Gives `request` a new id unless it has one.
template <typename Request>
void FillRequestId(Request& request) {
  if (request.request_id().empty()) request.set_request_id(NewRequestId());
}

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_REQUEST_ID_H_
