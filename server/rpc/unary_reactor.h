// A call with one request and one response whose body runs on the pool.
//
//   return UnaryReactor::Start(environment, context, request,
//                              {"ShapeService.GetShape", WorkClass::kQuick},
//                              [=](const UnaryCall& call) { ... });
//
// gRPC keeps request and response alive until the call is done.
#ifndef ARGMESH_SERVER_RPC_UNARY_REACTOR_H_
#define ARGMESH_SERVER_RPC_UNARY_REACTOR_H_

#include <functional>
#include <utility>

#include "server/rpc/guarded_reactor.h"

namespace argmesh {

struct UnaryPlan {
  const char* method;  // "ShapeService.GetShape"
  WorkClass work_class = WorkClass::kQuick;
  Admission* admission = nullptr;  // none: not limited
};

// What the body of a call is given beside its messages.
struct UnaryCall {
  const StopToken& stop;
  const Caller& caller;
};

class UnaryReactor final : public GuardedReactor<grpc::ServerUnaryReactor> {
 public:
  using Message = google::protobuf::Message;
  // Fills the response; its status ends the call.
  using Body = std::function<absl::Status(const UnaryCall&)>;

  static grpc::ServerUnaryReactor* Start(ServiceEnvironment& environment,
                                         grpc::CallbackServerContext* context,
                                         const Message* request,
                                         const UnaryPlan& plan, Body body);

  // Ends the call with METHOD_NOT_SERVED.
  static grpc::ServerUnaryReactor* NotServed(
      ServiceEnvironment& environment, grpc::CallbackServerContext* context,
      const Message* request, const char* method);

  UnaryReactor(ServiceEnvironment& environment,
               grpc::CallbackServerContext* context, const Message* request,
               const UnaryPlan& plan, Body body);

 protected:
  void Begin() override;

 private:
  const UnaryPlan plan_;
  const Body body_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_UNARY_REACTOR_H_
