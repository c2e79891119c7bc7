// Answers that are made and that their callers have not taken: a bound on the
// memory of all of them.
//
// Beyond it the oldest answers of the connection that holds the most are cut,
// so that who takes what it asks for loses nothing to who does not.
// Thread-safe.
#ifndef ARGMESH_SERVER_RPC_UNREAD_ANSWERS_H_
#define ARGMESH_SERVER_RPC_UNREAD_ANSWERS_H_

#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <string>

#include "server/rpc/call_registry.h"

namespace argmesh {

class UnreadAnswers {
 public:
  explicit UnreadAnswers(int64_t max_bytes) : max_bytes_(max_bytes) {}

  // `call` of the connection `peer` sends its answer of so many bytes. Once a
  // call; OnNotTaken of other calls, or of this one, may be called meanwhile.
  void Add(LiveCall* call, const std::string& peer, int64_t bytes);
  // Always, when the call is done: nothing of it is called afterwards.
  void Remove(LiveCall* call);

  int64_t bytes() const;
  int64_t cut() const;  // answers since the start

 private:
  struct Connection {
    int64_t bytes = 0;
    std::deque<LiveCall*> calls;  // oldest first
  };
  struct Answer {
    std::map<std::string, Connection>::iterator connection;
    int64_t bytes = 0;
  };

  LiveCall* OldestOfTheLargest() const;
  void Forget(std::map<LiveCall*, Answer>::iterator answer);

  const int64_t max_bytes_;
  mutable std::mutex mutex_;
  std::map<std::string, Connection> connections_;
  std::map<LiveCall*, Answer> answers_;
  int64_t bytes_ = 0;
  int64_t cut_ = 0;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_UNREAD_ANSWERS_H_
