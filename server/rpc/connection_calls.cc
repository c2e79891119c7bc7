#include "server/rpc/connection_calls.h"

namespace argmesh {

bool ConnectionCalls::Enter(const std::string& peer) {
  int calls = 0;
  {
    const std::lock_guard lock(mutex_);
    calls = ++calls_[peer];
  }
  if (calls <= kMaxCalls) return true;
  // Once, not for every call that is still read from it.
  if (calls == kMaxCalls + 1 && cut_) cut_(peer);
  return false;
}

void ConnectionCalls::Leave(const std::string& peer) {
  const std::lock_guard lock(mutex_);
  const auto calls = calls_.find(peer);
  if (--calls->second == 0) calls_.erase(calls);
}

}  // namespace argmesh
