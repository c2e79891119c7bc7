// What calls hold in memory for their peers, as answers that are not taken: a
// bound on all of it, and room for so much of each connection.
//
// Beyond the bound the oldest calls of the connection that holds the most are
// cut, so that who takes what it asks for loses nothing to who does not. Beyond
// its room a connection's next calls can wait. Thread-safe.
#ifndef ARGMESH_SERVER_RPC_PEER_BUDGET_H_
#define ARGMESH_SERVER_RPC_PEER_BUDGET_H_

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string>

#include "server/rpc/call_registry.h"

namespace argmesh {

class PeerBudget {
 public:
  using Step = std::function<void()>;

  explicit PeerBudget(int64_t max_bytes) : PeerBudget(max_bytes, max_bytes) {}
  PeerBudget(int64_t max_bytes, int64_t room_of_a_peer)
      : max_bytes_(max_bytes), room_(room_of_a_peer) {}

  // `call` of the connection `peer` holds so many bytes, instead of what it
  // held; OnOverBudget of other calls, or of this one, may be called meanwhile.
  void Hold(LiveCall* call, const std::string& peer, int64_t bytes);
  // It holds nothing more and waits for nothing, or is done: nothing of it is
  // called afterwards. Runs a step of its connection that waits for room.
  void Remove(LiveCall* call, const std::string& peer);

  // Whether what the connection holds is less than its room.
  bool HasRoom(const std::string& peer) const;
  // Keeps `step` of `call`, which a Remove will run once there is room, one
  // each time; it is dropped when the call is removed before. False, and
  // nothing is kept, when there is room.
  bool AwaitRoom(LiveCall* call, const std::string& peer, Step step);

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
  struct Waiting {
    LiveCall* call = nullptr;
    Step step;
  };

  bool HasRoomLocked(const std::string& peer) const;
  LiveCall* OldestOfTheLargest() const;
  void Forget(std::map<LiveCall*, Holding>::iterator holding);
  // Takes out the first that waits where there is room, if there is any.
  Step TakeNext(const std::string& peer);

  const int64_t max_bytes_;
  const int64_t room_;
  mutable std::mutex mutex_;
  std::map<std::string, Connection> connections_;
  std::map<LiveCall*, Holding> holdings_;
  std::map<std::string, std::deque<Waiting>> waiting_;  // none is empty
  int64_t bytes_ = 0;
  int64_t cut_ = 0;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_PEER_BUDGET_H_
