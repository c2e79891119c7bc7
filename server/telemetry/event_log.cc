#include "server/telemetry/event_log.h"

#include <nlohmann/json.hpp>

#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"

namespace argmesh {
namespace {

constexpr std::pair<LogLevel, std::string_view> kLevels[] = {
    {LogLevel::kDebug, "debug"},
    {LogLevel::kInfo, "info"},
    {LogLevel::kWarning, "warning"},
    {LogLevel::kError, "error"},
};

}  // namespace

std::string_view LogLevelName(LogLevel level) {
  return kLevels[static_cast<size_t>(level)].second;
}

absl::StatusOr<LogLevel> ParseLogLevel(std::string_view name) {
  for (const auto& [level, text] : kLevels) {
    if (text == name) return level;
  }
  return absl::InvalidArgumentError(
      absl::StrFormat("log level '%s' is not one of debug, info, warning, "
                      "error",
                      std::string(name)));
}

std::string LogTime(absl::Time time) {
  return absl::FormatTime("%Y-%m-%dT%H:%M:%E3SZ", time, absl::UTCTimeZone());
}

std::string LogLine(const LogFields& fields) {
  nlohmann::ordered_json line;
  for (const auto& [key, value] : fields) {
    std::visit([&, &name = key](const auto& held) { line[name] = held; },
               value);
  }
  return line.dump(-1, ' ', false,
                   nlohmann::ordered_json::error_handler_t::replace);
}

void EventLog::Write(LogLevel level, std::string_view message,
                     const LogFields& fields) {
  if (!Takes(level)) return;
  LogFields line = {{"ts", LogTime(absl::Now())},
                    {"level", std::string(LogLevelName(level))},
                    {"msg", std::string(message)}};
  line.insert(line.end(), fields.begin(), fields.end());
  const std::string text = LogLine(line);
  const std::lock_guard lock(mutex_);
  out_ << text << '\n';
  out_.flush();
}

}  // namespace argmesh
