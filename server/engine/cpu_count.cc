#include "server/engine/cpu_count.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

namespace argmesh {
namespace {

std::string FirstLine(const char* path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

}  // namespace

std::optional<int> CpusOfQuota(std::string_view cpu_max) {
  std::istringstream in{std::string(cpu_max)};
  int64_t quota = 0;
  int64_t period = 0;
  if (!(in >> quota >> period) || quota <= 0 || period <= 0) {
    return std::nullopt;
  }
  return static_cast<int>(
      std::clamp<int64_t>((quota + period - 1) / period, 1, 4096));
}

int AvailableCpus() {
  int cpus = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const std::string version1 =
      FirstLine("/sys/fs/cgroup/cpu/cpu.cfs_quota_us") + " " +
      FirstLine("/sys/fs/cgroup/cpu/cpu.cfs_period_us");
  for (const std::string& quota :
       {FirstLine("/sys/fs/cgroup/cpu.max"), version1}) {
    if (const auto limit = CpusOfQuota(quota)) cpus = std::min(cpus, *limit);
  }
  return cpus;
}

}  // namespace argmesh
