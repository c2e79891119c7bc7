#include "server/rpc/peer_budget.h"

#include <algorithm>

namespace argmesh {

void PeerBudget::Hold(LiveCall* call, const std::string& peer, int64_t bytes) {
  const std::lock_guard lock(mutex_);
  if (const auto held = holdings_.find(call); held != holdings_.end()) {
    Forget(held);
  }
  const auto connection = connections_.try_emplace(peer).first;
  connection->second.bytes += bytes;
  connection->second.calls.push_back(call);
  holdings_.emplace(call, Holding{connection, bytes});
  bytes_ += bytes;
  while (bytes_ > max_bytes_) {
    LiveCall* const oldest = OldestOfTheLargest();
    Forget(holdings_.find(oldest));
    ++cut_;
    // Under the lock, so that no call is done while it is told.
    oldest->OnOverBudget();
  }
}

void PeerBudget::Remove(LiveCall* call) {
  const std::lock_guard lock(mutex_);
  const auto holding = holdings_.find(call);
  if (holding != holdings_.end()) Forget(holding);
}

int64_t PeerBudget::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

int64_t PeerBudget::cut() const {
  const std::lock_guard lock(mutex_);
  return cut_;
}

LiveCall* PeerBudget::OldestOfTheLargest() const {
  const auto largest =
      std::max_element(connections_.begin(), connections_.end(),
                       [](const auto& a, const auto& b) {
                         return a.second.bytes < b.second.bytes;
                       });
  return largest->second.calls.front();
}

void PeerBudget::Forget(std::map<LiveCall*, Holding>::iterator holding) {
  const auto connection = holding->second.connection;
  std::deque<LiveCall*>& calls = connection->second.calls;
  calls.erase(std::find(calls.begin(), calls.end(), holding->first));
  connection->second.bytes -= holding->second.bytes;
  bytes_ -= holding->second.bytes;
  if (calls.empty()) connections_.erase(connection);
  holdings_.erase(holding);
}

}  // namespace argmesh
