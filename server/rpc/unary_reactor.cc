#include "server/rpc/unary_reactor.h"

namespace argmesh {
namespace {

std::unique_ptr<UnaryMethod::Message> EmptyOf(
    const UnaryMethod::Message& type) {
  return std::unique_ptr<UnaryMethod::Message>(type.New());
}

}  // namespace

UnaryReactor::UnaryReactor(ServiceEnvironment& environment,
                           grpc::CallbackServerContext* context,
                           const UnaryMethod& method)
    : AnsweringReactor(EmptyOf(method.response), environment, context,
                       method.plan.method, EmptyOf(method.request)),
      method_(method) {}

void UnaryReactor::Requested(const UnaryMethod::Message& request) {
  const UnaryPlan& plan = method_.plan;
  if (plan.admission != nullptr && !AdmitTo(*plan.admission)) return;
  Run(plan.work_class, [this, &request] {
    FinishOnce(method_.body({environment(), stop(), scope().caller()}, request,
                            &response()));
  });
}

}  // namespace argmesh
