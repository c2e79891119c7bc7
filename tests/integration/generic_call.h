// One call of any method by its full name, whatever its kind: a message is
// sent, everything that comes back is read and dropped.
#ifndef ARGMESH_TESTS_INTEGRATION_GENERIC_CALL_H_
#define ARGMESH_TESTS_INTEGRATION_GENERIC_CALL_H_

#include <google/protobuf/message.h>
#include <grpcpp/grpcpp.h>

#include <memory>
#include <string>

namespace argmesh {

// `method` is "/argmesh.v1.ShapeService/GetShape"; `key` goes into the header
// `authorization` as a bearer, where it is not empty.
grpc::Status CallGenerically(const std::shared_ptr<grpc::Channel>& channel,
                             const std::string& method,
                             const google::protobuf::Message& request,
                             const std::string& key);

}  // namespace argmesh

#endif  // ARGMESH_TESTS_INTEGRATION_GENERIC_CALL_H_
