// How many calls of one class may be at work or waiting at once.
//
// Refuses at once with OVERLOADED and a retry delay instead of queueing
// without bound. Thread-safe.
#ifndef ARGMESH_SERVER_RPC_ADMISSION_H_
#define ARGMESH_SERVER_RPC_ADMISSION_H_

#include <atomic>
#include <string>

#include "absl/status/statusor.h"

namespace argmesh {

class Admission {
 public:
  // Gives its place back when destroyed.
  class Ticket {
   public:
    Ticket() = default;
    explicit Ticket(std::atomic<int>* used) : used_(used) {}
    ~Ticket() { Release(); }
    Ticket(Ticket&& other) noexcept : used_(other.used_) {
      other.used_ = nullptr;
    }
    Ticket& operator=(Ticket&& other) noexcept;
    void Release();

   private:
    std::atomic<int>* used_ = nullptr;
  };

  // `what` names the class in messages: "searches". `limit` >= 1.
  Admission(std::string what, int limit);

  absl::StatusOr<Ticket> Admit();
  int limit() const { return limit_; }
  int used() const { return used_; }
  const std::string& what() const { return what_; }
  // Counts for the next Admit; those let in before stay.
  void SetLimit(int limit) { limit_ = limit; }

 private:
  const std::string what_;
  std::atomic<int> limit_;
  std::atomic<int> used_{0};
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_ADMISSION_H_
