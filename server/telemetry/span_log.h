// Spans of finished calls as OTLP/JSON, one ExportTraceServiceRequest a line:
// what the file receiver of an OpenTelemetry collector reads.
//
// A call gives a server span and, when it ran on a pool, two children: `queue`
// (from its arrival to its turn) and `work`. A call whose caller does not
// sample gives none. Thread-safe.
#ifndef ARGMESH_SERVER_TELEMETRY_SPAN_LOG_H_
#define ARGMESH_SERVER_TELEMETRY_SPAN_LOG_H_

#include <memory>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/telemetry/call_record.h"
#include "server/telemetry/line_file.h"

namespace argmesh {

// The line of one call, without a line break. `record.trace` may be empty: the
// call then begins a trace of its own.
std::string SpanLine(const CallRecord& record);

class SpanLog {
 public:
  explicit SpanLog(std::unique_ptr<LineFile> file) : file_(std::move(file)) {}

  void Write(const CallRecord& record) {
    if (record.trace.sampled) file_->Write(SpanLine(record));
  }
  LineFile& file() { return *file_; }

 private:
  const std::unique_ptr<LineFile> file_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_TELEMETRY_SPAN_LOG_H_
