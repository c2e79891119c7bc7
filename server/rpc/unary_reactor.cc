#include "server/rpc/unary_reactor.h"

#include "core/base/status_macros.h"
#include "server/rpc/status.h"

namespace argmesh {

grpc::ServerUnaryReactor* UnaryReactor::Start(
    ServiceEnvironment& environment, grpc::CallbackServerContext* context,
    const Message* request, const UnaryPlan& plan, Body body) {
  return StartReactor<UnaryReactor>(environment, context, request, plan,
                                    std::move(body));
}

grpc::ServerUnaryReactor* UnaryReactor::NotServed(
    ServiceEnvironment& environment, grpc::CallbackServerContext* context,
    const Message* request, const char* method) {
  return StartReactor<UnaryReactor>(environment, context, request,
                                    UnaryPlan{method}, Body());
}

UnaryReactor::UnaryReactor(ServiceEnvironment& environment,
                           grpc::CallbackServerContext* context,
                           const Message* request, const UnaryPlan& plan,
                           Body body)
    : GuardedReactor(environment, context, request, plan.method),
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

}  // namespace argmesh
