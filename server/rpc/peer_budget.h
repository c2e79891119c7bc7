// What calls hold in memory for their peers, as answers that are not taken: a
// bound on all of it.
//
// Beyond it the oldest calls of the connection that holds the most are cut, so
// that who takes what it asks for loses nothing to who does not. Thread-safe.
#ifndef ARGMESH_SERVER_RPC_PEER_BUDGET_H_
#define ARGMESH_SERVER_RPC_PEER_BUDGET_H_

#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <string>

#include "server/rpc/call_registry.h"

namespace argmesh {

class PeerBudget {
 public:
  explicit PeerBudget(int64_t max_bytes) : max_bytes_(max_bytes) {}

  // `call` of the connection `peer` holds so many bytes, instead of what it
  // held; OnOverBudget of other calls, or of this one, may be called meanwhile.
  void Hold(LiveCall* call, const std::string& peer, int64_t bytes);
  // It holds them no more, or is done: nothing of it is called afterwards.
  void Remove(LiveCall* call);

  int64_t bytes() const;
  int64_t cut() const;  // calls since the start

 private:
  struct Connection {
    int64_t bytes = 0;
    std::deque<LiveCall*> calls;  // oldest first
  };
  struct Holding {
    std::map<std::string, Connection>::iterator connection;
    int64_t bytes = 0;
  };

  LiveCall* OldestOfTheLargest() const;
  void Forget(std::map<LiveCall*, Holding>::iterator holding);

  const int64_t max_bytes_;
  mutable std::mutex mutex_;
  std::map<std::string, Connection> connections_;
  std::map<LiveCall*, Holding> holdings_;
  int64_t bytes_ = 0;
  int64_t cut_ = 0;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_PEER_BUDGET_H_
