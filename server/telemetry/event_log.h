// The server's log: one JSON object a line with fixed keys `ts`, `level`,
// `msg`, then those of the event. Never mesh bytes, keys or metadata.
//
// Thread-safe; a line is written whole.
#ifndef ARGMESH_SERVER_TELEMETRY_EVENT_LOG_H_
#define ARGMESH_SERVER_TELEMETRY_EVENT_LOG_H_

#include <atomic>
#include <cstdint>
#include <mutex>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/time/time.h"

namespace argmesh {

enum class LogLevel { kDebug, kInfo, kWarning, kError };

// "debug", "info", "warning", "error".
std::string_view LogLevelName(LogLevel level);
// kInvalidArgument for any other word.
absl::StatusOr<LogLevel> ParseLogLevel(std::string_view name);

using LogValue = std::variant<std::string, int64_t, double, bool>;
using LogFields = std::vector<std::pair<std::string, LogValue>>;

// RFC 3339 in UTC with milliseconds.
std::string LogTime(absl::Time time);
// One JSON object without a line break. Bytes that are not UTF-8 are replaced:
// a log line never throws.
std::string LogLine(const LogFields& fields);

class EventLog {
 public:
  // `out` must outlive the log.
  explicit EventLog(std::ostream& out, LogLevel lowest = LogLevel::kInfo)
      : out_(out), lowest_(lowest) {}

  // Events below `lowest` are dropped from now on.
  void SetLowest(LogLevel lowest) { lowest_ = lowest; }
  bool Takes(LogLevel level) const { return level >= lowest_; }

  void Write(LogLevel level, std::string_view message,
             const LogFields& fields = {});

 private:
  std::mutex mutex_;
  std::ostream& out_;
  std::atomic<LogLevel> lowest_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_TELEMETRY_EVENT_LOG_H_
