// What one call holds in the server's budgets and in its connection's room,
// until it is done: none of them must get a call that it has lost already.
// Thread-safe.
#ifndef ARGMESH_SERVER_RPC_CALL_HOLDINGS_H_
#define ARGMESH_SERVER_RPC_CALL_HOLDINGS_H_

#include <cstdint>
#include <mutex>
#include <set>
#include <string>

#include "server/rpc/answer_room.h"
#include "server/rpc/peer_budget.h"

namespace argmesh {

class CallHoldings {
 public:
  // `call` of the connection `peer`. All must outlive this.
  CallHoldings(LiveCall* call, const std::string& peer, AnswerRoom& room)
      : call_(call), peer_(peer), room_(room) {}

  // Counts `bytes` in `budget` instead of what it counts there; the call may be
  // cut meanwhile. Nothing once the call is done.
  void Hold(PeerBudget& budget, int64_t bytes);
  void LetGo(PeerBudget& budget) { budget.Remove(call_); }

  // Of AnswerRoom. Once the call is done nothing is kept, and it is never its
  // turn.
  bool EnterRoom() { return room_.Enter(call_, peer_); }
  bool EnterRoomOrWait(AnswerRoom::Step again);
  void HoldRoom(int64_t bytes);

  // The call is done.
  void Close();

 private:
  LiveCall* const call_;
  const std::string& peer_;
  AnswerRoom& room_;
  std::mutex mutex_;
  bool closed_ = false;            // with mutex_
  bool in_room_ = false;           // with mutex_
  std::set<PeerBudget*> budgets_;  // with mutex_
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_CALL_HOLDINGS_H_
