#include "server/process_heap.h"

#include <malloc.h>

#include "server/engine/cpu_count.h"

namespace argmesh {
namespace {

// Half of what glibc has. With fewer, threads of low priority that hold a heap
// keep others waiting.
constexpr int kHeapsPerCpu = 4;
// More than a message has: to map and unmap each costs others their time. Set,
// it is not raised up to 32 MiB.
constexpr int kLargeBytes = 4 << 20;

}  // namespace

void LimitHeaps() {
#ifdef __GLIBC__
  mallopt(M_ARENA_MAX, kHeapsPerCpu * AvailableCpus());
  mallopt(M_MMAP_THRESHOLD, kLargeBytes);
  mallopt(M_TRIM_THRESHOLD, 2 * kLargeBytes);
#endif
}

void TrimHeaps() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace argmesh
