// The calls in flight: counted for draining, woken for time-outs.
//
// Thread-safe. A call is entered before anything is done for it and left when
// gRPC is done with it; between the two the registry may call it from a thread
// of its own. It is held from its construction to its destruction: tasks on a
// pool may still end after gRPC is done, and what they use must still be there.
#ifndef ARGMESH_SERVER_RPC_CALL_REGISTRY_H_
#define ARGMESH_SERVER_RPC_CALL_REGISTRY_H_

#include <condition_variable>
#include <mutex>
#include <set>
#include <thread>

#include "absl/status/status.h"
#include "absl/time/time.h"

namespace argmesh {

// A call as the registry sees it. The functions must not block, throw, or call
// who calls them.
class LiveCall {
 public:
  virtual ~LiveCall() = default;
  // About every `tick`.
  virtual void OnTick(absl::Time) {}
  // Once: the server is going down and waits at most `grace`.
  virtual void OnDrain(absl::Duration) {}
  // What it holds for its peer is too much beside what others hold
  // (peer_budget.h).
  virtual void OnOverBudget() {}
};

class CallRegistry {
 public:
  // `tick` > 0.
  explicit CallRegistry(absl::Duration tick = absl::Milliseconds(100));
  // No call may be entered any more.
  ~CallRegistry();
  CallRegistry(const CallRegistry&) = delete;
  CallRegistry& operator=(const CallRegistry&) = delete;

  // DRAINING once the drain has begun; the call is entered nevertheless, so
  // that it can answer this, and must be left as any other.
  absl::Status Enter(LiveCall* call);
  void Leave(LiveCall* call);

  void Hold();
  void Release();

  int in_flight() const;  // entered and not left
  bool draining() const;

  // From now on Enter answers DRAINING; every call in flight is told.
  void StartDrain(absl::Duration grace);
  // Whether every call has left and been released by `deadline`.
  bool WaitUntilIdle(absl::Time deadline);

 private:
  void RunTicks();

  const absl::Duration tick_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::set<LiveCall*> calls_;
  int held_ = 0;
  bool draining_ = false;
  bool stopped_ = false;
  std::thread ticker_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_CALL_REGISTRY_H_
