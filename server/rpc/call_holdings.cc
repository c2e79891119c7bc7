#include "server/rpc/call_holdings.h"

#include <utility>

namespace argmesh {

void CallHoldings::Hold(PeerBudget& budget, int64_t bytes) {
  const std::lock_guard lock(mutex_);
  if (closed_) return;
  budgets_.insert(&budget);
  budget.Hold(call_, peer_, bytes);
}

bool CallHoldings::AwaitRoom(PeerBudget& budget, PeerBudget::Step step) {
  const std::lock_guard lock(mutex_);
  if (closed_) return true;
  budgets_.insert(&budget);
  return budget.AwaitRoom(call_, peer_, std::move(step));
}

void CallHoldings::Close() {
  std::set<PeerBudget*> budgets;
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    budgets.swap(budgets_);
  }
  for (PeerBudget* const budget : budgets) LetGo(*budget);
}

}  // namespace argmesh
