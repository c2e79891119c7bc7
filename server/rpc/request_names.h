// The resource names in a request, whatever its type.
#ifndef ARGMESH_SERVER_RPC_REQUEST_NAMES_H_
#define ARGMESH_SERVER_RPC_REQUEST_NAMES_H_

#include <google/protobuf/message.h>

#include <string>
#include <vector>

namespace argmesh {

// The values of all fields that name a resource (`name`, `names`, `parent`,
// `shape`, `collection`), and for a new collection its name to be, in the
// order of the fields; also in the messages that a request holds. Empty
// fields are left out. Names are not checked: that is the handler's task.
//
// Cost     O(fields), independent of the size of meshes and graphs.
std::vector<std::string> RequestNames(const google::protobuf::Message& request);

// "parts" of "collections/parts" and "collections/parts/shapes/valve"; empty
// for other names.
std::string CollectionOfName(const std::string& name);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_REQUEST_NAMES_H_
