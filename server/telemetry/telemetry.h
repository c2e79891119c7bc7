// Everything that is told of the server's work: its log, the audit log, spans,
// metrics. The one object that the services report to.
//
// Log      every call: an internal error as "error", a call that was refused
//          for load or rights as "warning", another failed one as "info", a
//          good one as "debug".
// Audit    calls that change what is stored, whatever their end, and calls
//          that were refused for missing rights. One JSON object a line.
// Thread-safe. Nothing here fails a call.
#ifndef ARGMESH_SERVER_TELEMETRY_TELEMETRY_H_
#define ARGMESH_SERVER_TELEMETRY_TELEMETRY_H_

#include <cstdint>
#include <memory>
#include <ostream>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/telemetry/call_metrics.h"
#include "server/telemetry/call_record.h"
#include "server/telemetry/event_log.h"
#include "server/telemetry/gauge_sheet.h"
#include "server/telemetry/span_log.h"

namespace argmesh {

struct TelemetryOptions {
  LogLevel log_level = LogLevel::kInfo;
  std::string audit_log;  // a file; empty: none
  std::string trace_log;  // a file; empty: none
  // Bound of each of the two files, as LineFile; 0: none.
  int64_t max_log_bytes = 0;
};

class Telemetry {
 public:
  // `log` must outlive it. kUnavailable when a file cannot be opened.
  static absl::StatusOr<std::unique_ptr<Telemetry>> Open(
      const TelemetryOptions& options, std::ostream& log);

  EventLog& log() { return log_; }
  const CallMetrics& metrics() const { return metrics_; }

  void CallStarted(std::string_view method) { metrics_.Started(method); }
  void CallFinished(const CallRecord& record);
  // One item of a stream, with the item's own resource, code and reason.
  void ItemFinished(const CallRecord& record);
  // As CallMetrics.
  void SearchStageFinished(std::string_view mode, std::string_view stage,
                           absl::Duration elapsed) {
    metrics_.SearchStageFinished(mode, stage, elapsed);
  }

  // Opens the files again, after they were renamed. The first error; a file
  // that cannot be opened again goes on as it was.
  absl::Status Reopen();

  void WriteGauges(GaugeSheet& sheet) const;

 private:
  Telemetry(std::ostream& log, LogLevel lowest) : log_(log, lowest) {}
  void Audit(const CallRecord& record);

  EventLog log_;
  CallMetrics metrics_;
  std::unique_ptr<LineFile> audit_;  // none: no audit log
  std::unique_ptr<SpanLog> spans_;   // none: no spans
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_TELEMETRY_TELEMETRY_H_
