// The health check of Client.
//
// grpc.health.v1 has one string in the request and one enum in the response,
// each in field 1: on the wire these are a StringValue and an Int32Value.
#include <google/protobuf/wrappers.pb.h>
#include <grpcpp/completion_queue.h>
#include <grpcpp/generic/generic_stub.h>

#include "client/client.h"
#include "client/client_parts.h"

namespace argmesh {
namespace {

std::string HealthName(int status) {
  switch (status) {
    case 1:
      return "SERVING";
    case 2:
      return "NOT_SERVING";
    case 3:
      return "SERVICE_UNKNOWN";
    default:
      return "UNKNOWN";
  }
}

}  // namespace

absl::StatusOr<std::string> Client::CheckHealth(std::string_view service) {
  google::protobuf::StringValue request;
  request.set_value(std::string(service));
  grpc::TemplatedGenericStub<google::protobuf::StringValue,
                             google::protobuf::Int32Value>
      stub(parts_->channel);
  grpc::ClientContext context;
  parts_->Prepare(absl::Now() + parts_->options.call_timeout, context);
  grpc::CompletionQueue queue;
  const auto call = stub.PrepareUnaryCall(
      &context, "/grpc.health.v1.Health/Check", request, &queue);
  call->StartCall();
  google::protobuf::Int32Value response;
  grpc::Status status;
  int tag = 0;
  call->Finish(&response, &status, &tag);
  void* done = nullptr;
  bool ok = false;
  queue.Next(&done, &ok);
  if (!status.ok()) return parts_->Explain(status);
  return HealthName(response.value());
}

}  // namespace argmesh
