// How long the steps of one piece of work take, one after the other.
#ifndef ARGMESH_CORE_BASE_STOPWATCH_H_
#define ARGMESH_CORE_BASE_STOPWATCH_H_

#include <utility>

#include "absl/time/clock.h"
#include "absl/time/time.h"

namespace argmesh {

// Starts when it is made. Belongs to one thread.
class Stopwatch {
 public:
  // Since it was made or last asked.
  absl::Duration Lap() {
    const absl::Time now = absl::Now();
    return now - std::exchange(start_, now);
  }

 private:
  absl::Time start_ = absl::Now();
};

}  // namespace argmesh

#endif  // ARGMESH_CORE_BASE_STOPWATCH_H_
