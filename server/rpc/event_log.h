// The server's log: one JSON object a line with fixed keys `ts`, `level`,
// `msg`, then those of the event. Never mesh bytes, keys or metadata.
//
// Thread-safe; a line is written whole.
#ifndef ARGMESH_SERVER_RPC_EVENT_LOG_H_
#define ARGMESH_SERVER_RPC_EVENT_LOG_H_

#include <cstdint>
#include <mutex>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace argmesh {

enum class LogLevel { kInfo, kWarning, kError };

class EventLog {
 public:
  using Value = std::variant<std::string, int64_t, double, bool>;
  using Fields = std::vector<std::pair<std::string, Value>>;

  // `out` must outlive the log.
  explicit EventLog(std::ostream& out) : out_(out) {}

  void Write(LogLevel level, std::string_view message,
             const Fields& fields = {});

 private:
  std::mutex mutex_;
  std::ostream& out_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_EVENT_LOG_H_
