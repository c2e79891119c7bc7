#include <sys/resource.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "server/telemetry/engine_gauges.h"

namespace argmesh {
namespace {

double Seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) +
         static_cast<double>(time.tv_usec) * 1e-6;
}

void WriteCpu(GaugeSheet& sheet) {
  rusage usage{};
  if (::getrusage(RUSAGE_SELF, &usage) != 0) return;
  sheet.Counter("process_cpu_seconds_total", "CPU time, user and system.",
                Seconds(usage.ru_utime) + Seconds(usage.ru_stime));
}

// /proc/self/statm: pages of address space, pages in memory, ...
void WriteMemory(GaugeSheet& sheet) {
  std::ifstream statm("/proc/self/statm");
  int64_t virtual_pages = 0;
  int64_t resident_pages = 0;
  if (!(statm >> virtual_pages >> resident_pages)) return;
  const auto page = static_cast<double>(::sysconf(_SC_PAGESIZE));
  sheet.Gauge("process_virtual_memory_bytes", "Address space.",
              static_cast<double>(virtual_pages) * page);
  sheet.Gauge("process_resident_memory_bytes", "Memory.",
              static_cast<double>(resident_pages) * page);
}

void WriteOpenFiles(GaugeSheet& sheet) {
  std::error_code error;
  double count = 0;
  for (std::filesystem::directory_iterator it("/proc/self/fd", error), end;
       !error && it != end; it.increment(error)) {
    ++count;
  }
  if (!error) sheet.Gauge("process_open_fds", "Open files.", count);
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) == 0) {
    sheet.Gauge("process_max_fds", "Files that may be open.",
                static_cast<double>(limit.rlim_cur));
  }
}

}  // namespace

void WriteProcessGauges(GaugeSheet& sheet) {
  // Of the first call, which main makes before it serves.
  static const double start =
      absl::ToDoubleSeconds(absl::Now() - absl::UnixEpoch());
  sheet.Gauge("process_start_time_seconds", "Start, seconds since 1970.",
              start);
  WriteCpu(sheet);
  WriteMemory(sheet);
  WriteOpenFiles(sheet);
}

}  // namespace argmesh
