#include "server/rpc/wait_reactor.h"

#include <algorithm>
#include <utility>

#include "server/rpc/resource_name.h"

namespace argmesh {
namespace {

// The answer must reach the caller before the deadline.
constexpr absl::Duration kMargin = absl::Milliseconds(200);

}  // namespace

WaitReactor::WaitReactor(ServiceEnvironment& environment,
                         grpc::CallbackServerContext* context)
    : AnsweringReactor(std::make_unique<google::longrunning::Operation>(),
                       environment, context, "Operations.WaitOperation") {}

void WaitReactor::Requested(
    std::shared_ptr<const google::longrunning::WaitOperationRequest> request) {
  const absl::StatusOr<std::string> id =
      ParseOperationName("name", request->name());
  if (!id.ok()) {
    FinishOnce(id.status());
    return;
  }
  const absl::Time now = absl::Now();
  {
    const std::lock_guard lock(look_mutex_);
    id_ = *id;
    end_ = scope().deadline() - kMargin;
    if (request->has_timeout()) {
      end_ = std::min(end_, now + absl::Seconds(request->timeout().seconds()) +
                                absl::Nanoseconds(request->timeout().nanos()));
    }
  }
  Look(now);
}

void WaitReactor::Look(absl::Time now) {
  absl::Status status;
  {
    const std::lock_guard lock(look_mutex_);
    if (id_.empty() || answered_) return;
    absl::StatusOr<google::longrunning::Operation> operation =
        environment().operations.Get(id_);
    if (operation.ok() && !operation->done() && now < end_) return;
    answered_ = true;
    status = operation.status();
    if (operation.ok()) response() = *std::move(operation);
  }
  FinishOnce(status);  // without the lock: it may be the end of this object
}

void WaitReactor::OnTick(absl::Time now) {
  AnsweringReactor::OnTick(now);
  Guard([&] { Look(now); });
}

void WaitReactor::OnDrain(absl::Duration grace) {
  AnsweringReactor::OnDrain(grace);
  Guard([this] { Look(absl::InfiniteFuture()); });
}

void WaitReactor::Cancelled() {
  FinishOnce(absl::CancelledError("the client went away"));
}

}  // namespace argmesh
