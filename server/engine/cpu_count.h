// How many CPUs this process may really use: the smallest of its affinity and
// its cgroup's quota (rounded up), at least 1. Read once at the start.
#ifndef ARGMESH_SERVER_ENGINE_CPU_COUNT_H_
#define ARGMESH_SERVER_ENGINE_CPU_COUNT_H_

#include <optional>
#include <string_view>

namespace argmesh {

int AvailableCpus();

// CPUs of the content of a cgroup's cpu.max, "200000 100000" is 2; none for
// "max" and for anything else.
std::optional<int> CpusOfQuota(std::string_view cpu_max);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_CPU_COUNT_H_
