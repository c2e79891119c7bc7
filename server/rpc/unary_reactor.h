// A call with one request and one response whose body runs on the pool.
#ifndef ARGMESH_SERVER_RPC_UNARY_REACTOR_H_
#define ARGMESH_SERVER_RPC_UNARY_REACTOR_H_

#include <functional>
#include <memory>

#include "server/rpc/answering_reactor.h"
#include "server/rpc/request_reactor.h"

namespace argmesh {

struct UnaryPlan {
  const char* method;  // "ShapeService.GetShape"
  WorkClass work_class = WorkClass::kQuick;
  Admission* admission = nullptr;  // none: not limited
};

// What the body of a call is given beside its messages.
struct UnaryCall {
  ServiceEnvironment& environment;
  const StopToken& stop;
  const Caller& caller;
};

struct UnaryMethod {
  using Message = google::protobuf::Message;

  UnaryPlan plan;
  const Message& request;   // empty, of the type that is read
  const Message& response;  // empty, of the type that is answered
  // Fills the response; its status ends the call.
  std::function<absl::Status(const UnaryCall&, const Message& request,
                             Message* response)>
      body;
};

class UnaryReactor final
    : public AnsweringReactor<
          UnaryMethod::Message,
          RequestReactor<grpc::ServerBidiReactor<UnaryMethod::Message,
                                                 UnaryMethod::Message>,
                         UnaryMethod::Message>> {
 public:
  // `method` must outlive the call.
  UnaryReactor(ServiceEnvironment& environment,
               grpc::CallbackServerContext* context, const UnaryMethod& method);

 protected:
  void Requested(std::shared_ptr<const UnaryMethod::Message> request) override;

 private:
  void RequestedAgain(
      const std::shared_ptr<const UnaryMethod::Message>& request);

  const UnaryMethod& method_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_UNARY_REACTOR_H_
