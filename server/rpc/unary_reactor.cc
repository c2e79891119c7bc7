#include "server/rpc/unary_reactor.h"

#include <utility>

namespace argmesh {

UnaryReactor::UnaryReactor(ServiceEnvironment& environment,
                           grpc::CallbackServerContext* context,
                           const UnaryMethod& method)
    : AnsweringReactor(
          std::unique_ptr<UnaryMethod::Message>(method.response.New()),
          environment, context, method.plan.method, method.request),
      method_(method) {}

void UnaryReactor::Requested(
    std::shared_ptr<const UnaryMethod::Message> request) {
  const UnaryPlan& plan = method_.plan;
  if (plan.admission != nullptr && !AdmitTo(*plan.admission)) return;
  Run(plan.work_class, [this, request = std::move(request)]() mutable {
    if (Postpone(*request, [this, request] { RequestedAgain(request); })) {
      return;
    }
    const absl::Status status = method_.body(
        {environment(), stop(), scope().caller()}, *request, &response());
    // Before the answer, which waits until the caller takes it.
    request.reset();
    FinishOnce(status);
  });
}

void UnaryReactor::RequestedAgain(
    const std::shared_ptr<const UnaryMethod::Message>& request) {
  // The caller's key may have been revoked while it waited.
  if (const absl::Status status = scope().AuthorizeMessage(*request);
      status.ok()) {
    Requested(request);
  } else {
    FinishOnce(status);
  }
}

}  // namespace argmesh
