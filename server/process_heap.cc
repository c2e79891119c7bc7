#include "server/process_heap.h"

#include <malloc.h>

#include "server/engine/cpu_count.h"

namespace argmesh {
namespace {

// A quarter of what glibc has. With one, threads of low priority that hold a
// heap keep others waiting.
constexpr int kHeapsPerCpu = 2;
// Twice what glibc begins with; set, it is not raised up to 32 MiB.
constexpr int kLargeBytes = 256 << 10;

}  // namespace

void LimitHeaps() {
#ifdef __GLIBC__
  mallopt(M_ARENA_MAX, kHeapsPerCpu * AvailableCpus());
  mallopt(M_MMAP_THRESHOLD, kLargeBytes);
  mallopt(M_TRIM_THRESHOLD, 4 * kLargeBytes);
#endif
}

void TrimHeaps() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace argmesh
