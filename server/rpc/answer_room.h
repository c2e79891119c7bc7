// Whose turn it is to have an answer made: while a connection has not taken as
// much of its answers as it has room for, its next calls wait, in their order.
//
// A call enters before its answer is made, holds the answer's size once it is,
// and is removed when it is done. Each that enters may let the next in
// (LetNextIn), so that what is made at a time is bounded by threads only until
// the room is full. Thread-safe.
#ifndef ARGMESH_SERVER_RPC_ANSWER_ROOM_H_
#define ARGMESH_SERVER_RPC_ANSWER_ROOM_H_

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <unordered_map>

#include "server/rpc/call_registry.h"

namespace argmesh {

class AnswerRoom {
 public:
  using Step = std::function<void()>;

  // Bytes of answers that are not taken, beyond which a connection waits.
  explicit AnswerRoom(int64_t bytes_of_a_peer) : room_(bytes_of_a_peer) {}

  // Whether the answer of `call` may be made now.
  bool Enter(LiveCall* call, const std::string& peer);
  // The same, and when it may not `again` is kept: once it is the call's turn
  // whoever makes room runs it, and it is to enter again. Dropped when the call
  // is removed before.
  bool EnterOrWait(LiveCall* call, const std::string& peer, Step again);
  // Runs what waits first, if there is room. Without a lock that it may need.
  void LetNextIn(const std::string& peer);

  // The answer of `call` is made, and not taken yet.
  void Hold(LiveCall* call, const std::string& peer, int64_t bytes);
  // The call is done. Lets the next in.
  void Remove(LiveCall* call, const std::string& peer);

 private:
  struct Waiting {
    LiveCall* call = nullptr;
    Step again;
  };
  struct Connection {
    int64_t bytes = 0;
    std::map<LiveCall*, int64_t> answers;
    std::deque<Waiting> waiting;
    std::set<LiveCall*> called;  // whose turn it is; they have not come yet
  };

  bool EnterLocked(LiveCall* call, const std::string& peer);
  // What waits first where there is room, if there is any. Locked.
  Step TakeNext(Connection& connection);

  const int64_t room_;
  std::mutex mutex_;
  std::unordered_map<std::string, Connection> connections_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_ANSWER_ROOM_H_
