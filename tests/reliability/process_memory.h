// The memory of another process, as the kernel counts it.
#ifndef ARGMESH_TESTS_RELIABILITY_PROCESS_MEMORY_H_
#define ARGMESH_TESTS_RELIABILITY_PROCESS_MEMORY_H_

#include <sys/types.h>

#include <cstdint>
#include <fstream>
#include <string>

namespace argmesh {

// A line "VmRSS:   1234 kB" of /proc/PID/status; 0 when there is none.
inline int64_t StatusBytes(pid_t pid, const std::string& key) {
  std::ifstream status("/proc/" + std::to_string(pid) + "/status");
  std::string word;
  while (status >> word) {
    int64_t kilobytes = 0;
    if (word == key + ":" && status >> kilobytes) return kilobytes << 10;
  }
  return 0;
}

inline int64_t ResidentBytes(pid_t pid) { return StatusBytes(pid, "VmRSS"); }

// The most that has been resident since ForgetPeak.
inline int64_t PeakBytes(pid_t pid) { return StatusBytes(pid, "VmHWM"); }
inline void ForgetPeak(pid_t pid) {
  std::ofstream("/proc/" + std::to_string(pid) + "/clear_refs") << "5";
}

}  // namespace argmesh

#endif  // ARGMESH_TESTS_RELIABILITY_PROCESS_MEMORY_H_
