#include "tests/integration/generic_call.h"

#include <grpcpp/generic/generic_stub.h>

#include <chrono>

namespace argmesh {

grpc::Status CallGenerically(const std::shared_ptr<grpc::Channel>& channel,
                             const std::string& method,
                             const google::protobuf::Message& request,
                             const std::string& key) {
  grpc::GenericStub stub(channel);
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() +
                       std::chrono::seconds(20));
  if (!key.empty()) context.AddMetadata("authorization", "Bearer " + key);
  grpc::CompletionQueue queue;
  int tag = 0;
  const auto wait = [&queue] {
    void* done = nullptr;
    bool ok = false;
    return queue.Next(&done, &ok) && ok;
  };
  const auto stream = stub.PrepareCall(&context, method, &queue);
  stream->StartCall(&tag);
  bool alive = wait();
  grpc::Slice slice(request.SerializeAsString());
  if (alive) {
    stream->Write(grpc::ByteBuffer(&slice, 1), &tag);
    alive = wait();
  }
  if (alive) {
    stream->WritesDone(&tag);
    (void)wait();
  }
  grpc::ByteBuffer answer;
  do {
    stream->Read(&answer, &tag);
  } while (wait());
  grpc::Status status;
  stream->Finish(&status, &tag);
  (void)wait();
  return status;
}

}  // namespace argmesh
