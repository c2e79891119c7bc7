#include "server/rpc/peer_budget.h"

#include <algorithm>
#include <utility>

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

void PeerBudget::Remove(LiveCall* call, const std::string& peer) {
  Step next;
  {
    const std::lock_guard lock(mutex_);
    const auto holding = holdings_.find(call);
    if (holding != holdings_.end()) Forget(holding);
    if (const auto waiting = waiting_.find(peer); waiting != waiting_.end()) {
      std::erase_if(waiting->second,
                    [call](const Waiting& w) { return w.call == call; });
      next = TakeNext(peer);
    }
  }
  if (next) next();
}

bool PeerBudget::HasRoom(const std::string& peer) const {
  const std::lock_guard lock(mutex_);
  return HasRoomLocked(peer);
}

bool PeerBudget::AwaitRoom(LiveCall* call, const std::string& peer, Step step) {
  const std::lock_guard lock(mutex_);
  if (HasRoomLocked(peer)) return false;
  waiting_[peer].push_back({call, std::move(step)});
  return true;
}

int64_t PeerBudget::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

int64_t PeerBudget::cut() const {
  const std::lock_guard lock(mutex_);
  return cut_;
}

bool PeerBudget::HasRoomLocked(const std::string& peer) const {
  const auto connection = connections_.find(peer);
  return connection == connections_.end() || connection->second.bytes < room_;
}

PeerBudget::Step PeerBudget::TakeNext(const std::string& peer) {
  const auto waiting = waiting_.find(peer);
  std::deque<Waiting>& steps = waiting->second;
  Step next;
  if (!steps.empty() && HasRoomLocked(peer)) {
    next = std::move(steps.front().step);
    steps.pop_front();
  }
  if (steps.empty()) waiting_.erase(waiting);
  return next;
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
