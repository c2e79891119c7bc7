// What one call holds in the server's budgets (peer_budget.h), until it is
// done: a budget must not get a call that it has lost already. Thread-safe.
#ifndef ARGMESH_SERVER_RPC_CALL_HOLDINGS_H_
#define ARGMESH_SERVER_RPC_CALL_HOLDINGS_H_

#include <cstdint>
#include <mutex>
#include <set>
#include <string>

#include "server/rpc/peer_budget.h"

namespace argmesh {

class CallHoldings {
 public:
  // `call` of the connection `peer`; both must outlive this.
  CallHoldings(LiveCall* call, const std::string& peer)
      : call_(call), peer_(peer) {}

  // As PeerBudget does, and nothing once the call is done.
  void Hold(PeerBudget& budget, int64_t bytes);
  void LetGo(PeerBudget& budget) { budget.Remove(call_, peer_); }
  // False where there is room; true, and `step` is dropped, for a call that is
  // done.
  bool AwaitRoom(PeerBudget& budget, PeerBudget::Step step);

  // The call is done.
  void Close();

 private:
  LiveCall* const call_;
  const std::string& peer_;
  std::mutex mutex_;
  bool closed_ = false;            // with mutex_
  std::set<PeerBudget*> budgets_;  // with mutex_
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_CALL_HOLDINGS_H_
