// How many calls of one class may be at work or waiting at once.
//
// Refuses at once with OVERLOADED and a retry delay instead of queueing
// without bound. The last quarter of the places, rounded down, is for
// connections that have none, so that one connection cannot keep the others
// out. Thread-safe.
#ifndef ARGMESH_SERVER_RPC_ADMISSION_H_
#define ARGMESH_SERVER_RPC_ADMISSION_H_

#include <atomic>
#include <mutex>
#include <string>
#include <unordered_map>
#include <utility>

#include "absl/status/statusor.h"

namespace argmesh {

class Admission {
 public:
  // Gives its place back when destroyed.
  class Ticket {
   public:
    Ticket() = default;
    Ticket(Admission& admission, std::string peer)
        : admission_(&admission), peer_(std::move(peer)) {}
    ~Ticket() { Release(); }
    Ticket(Ticket&& other) noexcept;
    Ticket& operator=(Ticket&& other) noexcept;
    void Release();

   private:
    Admission* admission_ = nullptr;
    std::string peer_;
  };

  // `what` names the class in messages: "searches". `limit` >= 1.
  Admission(std::string what, int limit);

  // A place for a call of the connection `peer`.
  absl::StatusOr<Ticket> Admit(const std::string& peer);
  int limit() const { return limit_; }
  int used() const;
  const std::string& what() const { return what_; }
  // Counts for the next Admit; those let in before stay.
  void SetLimit(int limit) { limit_ = limit; }

 private:
  void Leave(const std::string& peer);

  const std::string what_;
  std::atomic<int> limit_;
  mutable std::mutex mutex_;
  int used_ = 0;                                // with mutex_
  std::unordered_map<std::string, int> peers_;  // with mutex_; none is 0
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_ADMISSION_H_
