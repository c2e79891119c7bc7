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

 private:
  const std::string what_;
  const int limit_;
  std::atomic<int> used_{0};
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_ADMISSION_H_
