#include "server/rpc/unary_reactor.h"

#include "absl/time/clock.h"
#include "core/base/status_macros.h"
#include "server/rpc/status.h"

namespace argmesh {

grpc::ServerUnaryReactor* UnaryReactor::Start(
    ServiceEnvironment& environment, grpc::CallbackServerContext* context,
    const UnaryMessages& messages, const UnaryPlan& plan, Body body) {
  return StartReactor<UnaryReactor>(environment, context, messages, plan,
                                    std::move(body));
}

grpc::ServerUnaryReactor* UnaryReactor::NotServed(
    ServiceEnvironment& environment, grpc::CallbackServerContext* context,
    const Message* request, const char* method) {
  return StartReactor<UnaryReactor>(environment, context,
                                    UnaryMessages{request, nullptr},
                                    UnaryPlan{method}, Body());
}

UnaryReactor::UnaryReactor(ServiceEnvironment& environment,
                           grpc::CallbackServerContext* context,
                           const UnaryMessages& messages, const UnaryPlan& plan,
                           Body body)
    : GuardedReactor(environment, context, messages.request, plan.method),
      response_(messages.response),
      plan_(plan),
      body_(std::move(body)) {}

void UnaryReactor::Begin() {
  if (!body_) {
    FinishOnce(MethodNotServed(plan_.method));
    return;
  }
  if (plan_.admission != nullptr && !AdmitTo(*plan_.admission)) return;
  Run(plan_.work_class, [this] {
    FinishOnce(body_({stop(), scope().caller()}));
  });
}

void UnaryReactor::Finishing(const absl::Status& status) {
  answered_ms_ = absl::ToUnixMillis(absl::Now());
  if (!status.ok() || response_ == nullptr) return;
  environment().unread.Add(this, scope().context()->peer(),
                           static_cast<int64_t>(response_->ByteSizeLong()));
}

void UnaryReactor::OnTick(absl::Time now) {
  const int64_t answered = answered_ms_;
  if (answered != kNotAnswered && now - absl::FromUnixMillis(answered) >
                                      environment().stream_idle_timeout()) {
    OnNotTaken();
  }
}

// An answer that nobody takes blocks the end of the call: only a cancellation
// gets through.
void UnaryReactor::OnNotTaken() { scope().context()->TryCancel(); }

}  // namespace argmesh
