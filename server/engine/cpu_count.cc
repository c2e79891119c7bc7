#include "server/engine/cpu_count.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>

namespace argmesh {
namespace {

// Of version 2, whose line begins so in /proc/PID/cgroup.
constexpr std::string_view kVersion2 = "0::/";

std::string FirstLine(const std::filesystem::path& path) {
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

std::optional<int> CpusOfCgroup(const std::filesystem::path& root,
                                std::string_view cgroups) {
  std::filesystem::path group;  // below the root
  std::istringstream lines{std::string(cgroups)};
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(kVersion2)) {
      group =
          std::filesystem::path(line.substr(kVersion2.size())).relative_path();
    }
  }
  std::optional<int> least;
  while (true) {
    const auto cpus = CpusOfQuota(FirstLine(root / group / "cpu.max"));
    if (cpus) least = std::min(*cpus, least.value_or(*cpus));
    if (group.empty()) return least;
    group = group.parent_path();
  }
}

int AvailableCpus() {
  int cpus = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  std::ifstream own("/proc/self/cgroup");
  const std::string cgroups{std::istreambuf_iterator<char>(own), {}};
  const std::string version1 =
      FirstLine("/sys/fs/cgroup/cpu/cpu.cfs_quota_us") + " " +
      FirstLine("/sys/fs/cgroup/cpu/cpu.cfs_period_us");
  for (const std::optional<int> limit :
       {CpusOfCgroup("/sys/fs/cgroup", cgroups), CpusOfQuota(version1)}) {
    if (limit) cpus = std::min(cpus, *limit);
  }
  return cpus;
}

}  // namespace argmesh
