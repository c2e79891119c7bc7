// How many CPUs this process may really use: the smallest of its affinity and
// the quotas of its cgroups (rounded up; of version 1 the root's only), and at
// least 1. Read once at the start.
#ifndef ARGMESH_SERVER_ENGINE_CPU_COUNT_H_
#define ARGMESH_SERVER_ENGINE_CPU_COUNT_H_

#include <filesystem>
#include <optional>
#include <string_view>

namespace argmesh {

int AvailableCpus();

// CPUs of the content of a cgroup's cpu.max, "200000 100000" is 2; none for
// "max" and for anything else.
std::optional<int> CpusOfQuota(std::string_view cpu_max);

// The smallest quota of a process's cgroup (version 2) and those above it, as
// its unit, its container and the slices around them have; none without any.
// `cgroups` is the content of /proc/PID/cgroup, `root` is /sys/fs/cgroup.
std::optional<int> CpusOfCgroup(const std::filesystem::path& root,
                                std::string_view cgroups);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_CPU_COUNT_H_
