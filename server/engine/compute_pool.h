// The threads that blocking work runs on, and who is let in.
//
// Four bounded classes, so that none starves another: searches with all they
// need (also the graph of a query mesh), the computation of what is stored,
// short blocking calls (reads, upload chunks), and those that may touch many
// shapes or send megabytes (pages, batches, graphs). Threads of kCompute and
// kBulk run at a lower priority than the others.
//
// Work that cannot start within min(a quarter of the time to its deadline,
// `max_wait`) is refused with kResourceExhausted OVERLOADED and a retry delay;
// at once when the queue of its class is full. After Close: DRAINING.
//
// Callers who wait take turns: who asks for much makes the others wait for one
// of his at a time, and a full queue lets go of the newest work of the one who
// has the most waiting (fair_queue.h).
#ifndef ARGMESH_SERVER_ENGINE_COMPUTE_POOL_H_
#define ARGMESH_SERVER_ENGINE_COMPUTE_POOL_H_

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "absl/status/status.h"
#include "absl/time/time.h"

namespace argmesh {

enum class WorkClass { kSearch = 0, kCompute = 1, kQuick = 2, kBulk = 3 };
inline constexpr int kNumWorkClasses = 4;

// Of the classes, for so many CPUs: all for searches, one less (at least one)
// for computation and for bulk, twice as many for quick work.
std::array<int, kNumWorkClasses> ThreadsFor(int cpus);

struct ComputePoolOptions {
  // 0: ThreadsFor the CPUs of this process.
  std::array<int, kNumWorkClasses> threads = {0, 0, 0, 0};
  std::array<int, kNumWorkClasses> max_queued = {64, 64, 512, 512};
  absl::Duration max_wait = absl::Seconds(2);
};

struct WorkLoad {
  int threads = 0;
  int running = 0;
  int queued = 0;
  int64_t admitted = 0;  // since the start
  int64_t refused = 0;
};

class ComputePool {
 public:
  // Called exactly once: with OK on a thread of the class, or with the refusal
  // on any thread, possibly before its own Submit returns, never within that of
  // another. Must not throw.
  using Work = std::function<void(absl::Status admission)>;

  explicit ComputePool(const ComputePoolOptions& options = {});
  ~ComputePool();  // Close

  // `caller` is whom it is for, a connection; empty: the server itself.
  void Submit(WorkClass work_class, absl::Time deadline, Work work,
              const std::string& caller = "");

  // Runs `body(i)` for every i in 0 .. count-1 on the caller's thread and on
  // idle threads of the class; returns when all are done. The caller works
  // too, so that it may itself be work of the class.
  void ParallelFor(WorkClass work_class, int64_t count,
                   const std::function<void(int64_t)>& body);

  WorkLoad Load(WorkClass work_class) const;

  // Refuses what is queued and what comes, waits for what runs. Idempotent;
  // not from a pool's thread.
  void Close();

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_COMPUTE_POOL_H_
