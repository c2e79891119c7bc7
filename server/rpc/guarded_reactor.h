// The base of every reactor.
//
// gRPC's callback API never finishes a call whose reaction throws, and then
// hangs Shutdown. So every reaction is caught here; the call is finished
// exactly once; it is entered in the registry and left again; the caller's
// rights are checked before anything is done; cancellation and the deadline
// reach the StopToken; telemetry learns how the call ended; and the reactor
// lives as long as gRPC or a task on a pool needs it.
//
//   class CountReactor : public GuardedReactor<grpc::ServerWriteReactor<R>>
//   return StartReactor<CountReactor>(environment, context);
//
// No message is there yet when a call begins: ReadingReactor checks the rights
// to each that comes.
//
// A subclass overrides Begin and the protected reactions of its kind; all run
// outside the lock. After FinishOnce it starts nothing more.
#ifndef ARGMESH_SERVER_RPC_GUARDED_REACTOR_H_
#define ARGMESH_SERVER_RPC_GUARDED_REACTOR_H_

#include <grpcpp/grpcpp.h>

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/time/clock.h"
#include "server/engine/error_reason.h"
#include "server/rpc/call_holdings.h"
#include "server/rpc/call_scope.h"
#include "server/rpc/status.h"

namespace argmesh {

template <typename Base>
class GuardedReactor
    : public Base,
      public LiveCall,
      public std::enable_shared_from_this<GuardedReactor<Base>> {
 public:
  GuardedReactor(ServiceEnvironment& environment,
                 grpc::CallbackServerContext* context, const char* method)
      : held_(environment.calls),
        scope_(environment, context, method),
        holdings_(this, scope_.peer(), environment.answer_room) {}

  // Called once, by StartReactor.
  void Enter() {
    self_ = this->shared_from_this();
    Guard([this] {
      absl::Status status = environment().calls.Enter(this);
      if (!environment().connections.Enter(scope_.peer())) {
        status.Update(TooManyCallsOfAConnection());
      }
      if (status.ok()) status = scope_.Authorize();
      if (status.ok()) {
        Begin();
      } else {
        FinishOnce(status);
      }
    });
  }

  void OnCancel() final {
    scope_.RequestStop();
    Guard([this] { Cancelled(); });
  }

  void OnDone() final {
    holdings_.Close();
    environment().calls.Leave(this);
    environment().connections.Leave(scope_.peer());
    self_.reset();  // may delete this
  }

 protected:
  // The call's first step.
  virtual void Begin() = 0;
  // Hands the call's end to gRPC. Once, by FinishOnce.
  virtual void End(const grpc::Status& status) { this->Finish(status); }
  // The caller went away, or the deadline passed. stop() says so already.
  virtual void Cancelled() {}

  ServiceEnvironment& environment() { return scope_.environment(); }
  Engine& engine() { return scope_.environment().engine; }
  CallScope& scope() { return scope_; }
  const StopToken& stop() const { return scope_.stop(); }

  // The first call ends the rpc; others do nothing.
  void FinishOnce(const absl::Status& status) {
    if (!scope_.MarkFinished()) return;
    // What still runs for the call is for nobody.
    scope_.RequestStop();
    // Before the client can know: its next call must not be refused for this
    // one.
    scope_.ReleaseQuota();
    ReleasePlace();
    End(scope_.Report(status));
  }

  // Takes a place of its class until the call is finished, instead of the one
  // it has; ends the call and returns false when there is none.
  bool AdmitTo(Admission& admission) {
    absl::StatusOr<Admission::Ticket> ticket = admission.Admit(scope_.peer());
    if (!ticket.ok()) {
      FinishOnce(ticket.status());
      return false;
    }
    const std::lock_guard lock(scope_.mutex());
    if (!scope_.finished()) ticket_ = *std::move(ticket);
    return true;
  }

  // Not with the scope's mutex: the call may be cut.
  CallHoldings& holdings() { return holdings_; }

  // Gives the place back before the call is finished.
  void ReleasePlace() {
    const std::lock_guard lock(scope_.mutex());
    ticket_.Release();
  }

  // Runs `step`; what it throws ends the call.
  template <typename Step>
  void Guard(Step&& step) noexcept {
    try {
      step();
    } catch (...) {
      FinishOnce(CallScope::CurrentException());
    }
  }

  // Runs `step` on the engine's pool, or ends the call when it is not let in.
  void Run(WorkClass work_class, std::function<void()> step) {
    Submit({work_class, std::move(step), /*patient=*/false});
  }

  // The same for work of a stream that was let in before: while the pool is
  // overloaded the step waits, as long as the deadline allows. The subclass
  // calls ResubmitWaiting from OnTick.
  void RunPatiently(WorkClass work_class, std::function<void()> step) {
    Submit({work_class, std::move(step), /*patient=*/true});
  }

  void ResubmitWaiting() {
    std::vector<PoolStep> steps;
    {
      const std::lock_guard lock(scope_.mutex());
      steps.swap(waiting_);
    }
    for (PoolStep& step : steps) Submit(std::move(step));
  }

 private:
  struct PoolStep {
    WorkClass work_class;
    std::function<void()> body;
    bool patient;
  };

  void Submit(PoolStep step) {
    const WorkClass work_class = step.work_class;
    engine().pool().Submit(
        work_class, scope_.deadline(),
        [this, self = this->shared_from_this(),
         step = std::move(step)](const absl::Status& admission) {
          Guard([&] { RunStep(step, admission); });
        },
        scope_.peer());
  }

  void RunStep(const PoolStep& step, const absl::Status& admission) {
    scope_.MarkWorkBegin();
    if (const absl::Status stopped = scope_.stop().Check(); !stopped.ok()) {
      FinishOnce(stopped);
    } else if (admission.ok()) {
      step.body();
    } else if (step.patient &&
               ReasonOf(admission) == ErrorReason::kOverloaded) {
      const std::lock_guard lock(scope_.mutex());
      if (!scope_.finished()) waiting_.push_back(step);
    } else {
      FinishOnce(admission);
    }
  }

  // Destroyed last: then nothing of the call uses the server any more.
  struct Held {
    explicit Held(CallRegistry& the_calls) : calls(the_calls) { calls.Hold(); }
    ~Held() { calls.Release(); }
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
    CallRegistry& calls;
  };

  const Held held_;
  CallScope scope_;
  CallHoldings holdings_;
  Admission::Ticket ticket_;              // with the scope's mutex
  std::vector<PoolStep> waiting_;         // with the scope's mutex
  std::shared_ptr<GuardedReactor> self_;  // until OnDone
};

template <typename Reactor, typename... Args>
Reactor* StartReactor(Args&&... args) {
  const auto reactor = std::make_shared<Reactor>(std::forward<Args>(args)...);
  reactor->Enter();
  return reactor.get();
}

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_GUARDED_REACTOR_H_
