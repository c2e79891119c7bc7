// Waiting for operations, and looking into them.
#ifndef ARGMESH_TESTS_INTEGRATION_OPERATION_WAIT_H_
#define ARGMESH_TESTS_INTEGRATION_OPERATION_WAIT_H_

#include <gtest/gtest.h>

#include <string>

#include "tests/integration/server_fixture.h"

namespace argmesh {

// The operation once it is done.
inline google::longrunning::Operation WaitForOperation(
    TestServer& server, const std::string& name) {
  grpc::ClientContext context;
  google::longrunning::WaitOperationRequest request;
  request.set_name(name);
  request.mutable_timeout()->set_seconds(60);
  google::longrunning::Operation operation;
  const grpc::Status status =
      server.operations().WaitOperation(&context, request, &operation);
  EXPECT_TRUE(status.ok()) << ErrorOf(status);
  EXPECT_TRUE(operation.done());
  return operation;
}

inline void CancelOperation(TestServer& server, const std::string& name) {
  grpc::ClientContext context;
  google::longrunning::CancelOperationRequest request;
  request.set_name(name);
  google::protobuf::Empty nothing;
  const grpc::Status status =
      server.operations().CancelOperation(&context, request, &nothing);
  EXPECT_TRUE(status.ok()) << ErrorOf(status);
}

inline v1::OperationMetadata MetadataOf(
    const google::longrunning::Operation& operation) {
  v1::OperationMetadata metadata;
  EXPECT_TRUE(operation.metadata().UnpackTo(&metadata));
  return metadata;
}

template <typename Response>
Response ResponseOf(const google::longrunning::Operation& operation) {
  Response response;
  EXPECT_TRUE(operation.response().UnpackTo(&response))
      << operation.DebugString();
  return response;
}

}  // namespace argmesh

#endif  // ARGMESH_TESTS_INTEGRATION_OPERATION_WAIT_H_
