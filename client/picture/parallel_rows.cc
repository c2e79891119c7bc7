#include "client/picture/parallel_rows.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace argmesh {

void ParallelRows(int rows, int threads, const std::function<void(int)>& row) {
  if (threads == 0) {
    threads =
        std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  }
  std::atomic<int> next = 0;
  const auto work = [&] {
    for (int r = next.fetch_add(1); r < rows; r = next.fetch_add(1)) row(r);
  };
  std::vector<std::jthread> others;
  for (int t = 1; t < std::min(threads, rows); ++t) others.emplace_back(work);
  work();
}

}  // namespace argmesh
