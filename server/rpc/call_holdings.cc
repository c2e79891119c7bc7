#include "server/rpc/call_holdings.h"

#include <utility>

namespace argmesh {

void CallHoldings::Hold(PeerBudget& budget, int64_t bytes) {
  const std::lock_guard lock(mutex_);
  if (closed_) return;
  budgets_.insert(&budget);
  budget.Hold(call_, peer_, bytes);
}

bool CallHoldings::EnterRoomOrWait(AnswerRoom::Step again) {
  const std::lock_guard lock(mutex_);
  if (closed_) return false;
  in_room_ = true;
  return room_.EnterOrWait(call_, peer_, std::move(again));
}

void CallHoldings::HoldRoom(int64_t bytes) {
  const std::lock_guard lock(mutex_);
  if (closed_) return;
  in_room_ = true;
  room_.Hold(call_, peer_, bytes);
}

void CallHoldings::Close() {
  std::set<PeerBudget*> budgets;
  bool in_room = false;
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    budgets.swap(budgets_);
    in_room = in_room_;
  }
  for (PeerBudget* const budget : budgets) LetGo(*budget);
  if (in_room) room_.Remove(call_, peer_);
}

}  // namespace argmesh
