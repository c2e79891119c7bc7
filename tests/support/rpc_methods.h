// Every rpc the server declares, from the descriptors: a test over them covers
// a new one by itself.
#ifndef ARGMESH_TESTS_SUPPORT_RPC_METHODS_H_
#define ARGMESH_TESTS_SUPPORT_RPC_METHODS_H_

#include <google/protobuf/descriptor.h>

#include <vector>

namespace argmesh {

// Of argmesh.v1 and google.longrunning.
std::vector<const google::protobuf::MethodDescriptor*> AllMethods();

}  // namespace argmesh

#endif  // ARGMESH_TESTS_SUPPORT_RPC_METHODS_H_
