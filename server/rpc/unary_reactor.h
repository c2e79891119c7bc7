// A call with one request and one response whose body runs on the pool.
//
//   return UnaryReactor::Start(environment, context, {request, response},
//                              {"ShapeService.GetShape", WorkClass::kQuick},
//                              [=](const UnaryCall& call) { ... });
//
// gRPC keeps request and response alive until the call is done: a caller that
// does not take its answer within the stream idle timeout, or whose answers
// take the memory of others (unread_answers.h), is cut.
#ifndef ARGMESH_SERVER_RPC_UNARY_REACTOR_H_
#define ARGMESH_SERVER_RPC_UNARY_REACTOR_H_

#include <atomic>
#include <cstdint>
#include <functional>
#include <utility>

#include "server/rpc/guarded_reactor.h"

namespace argmesh {

struct UnaryPlan {
  const char* method;  // "ShapeService.GetShape"
  WorkClass work_class = WorkClass::kQuick;
  Admission* admission = nullptr;  // none: not limited
};

struct UnaryMessages {
  const google::protobuf::Message* request;
  const google::protobuf::Message* response;
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
                                         const UnaryMessages& messages,
                                         const UnaryPlan& plan, Body body);

  // Ends the call with METHOD_NOT_SERVED.
  static grpc::ServerUnaryReactor* NotServed(
      ServiceEnvironment& environment, grpc::CallbackServerContext* context,
      const Message* request, const char* method);

  UnaryReactor(ServiceEnvironment& environment,
               grpc::CallbackServerContext* context,
               const UnaryMessages& messages, const UnaryPlan& plan, Body body);

  void OnTick(absl::Time now) override;
  void OnNotTaken() override;

 protected:
  void Begin() override;
  void Finishing(const absl::Status& status) override;

 private:
  static constexpr int64_t kNotAnswered = -1;

  const Message* const response_;  // null: never filled
  const UnaryPlan plan_;
  const Body body_;
  std::atomic<int64_t> answered_ms_{kNotAnswered};
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_UNARY_REACTOR_H_
