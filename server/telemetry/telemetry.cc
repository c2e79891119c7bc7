#include "server/telemetry/telemetry.h"

#include "core/base/status_macros.h"

namespace argmesh {
namespace {

bool IsDenial(absl::StatusCode code) {
  return code == absl::StatusCode::kUnauthenticated ||
         code == absl::StatusCode::kPermissionDenied;
}

LogLevel LevelOf(absl::StatusCode code) {
  switch (code) {
    case absl::StatusCode::kOk:
      return LogLevel::kDebug;
    case absl::StatusCode::kInternal:
    case absl::StatusCode::kDataLoss:
      return LogLevel::kError;
    case absl::StatusCode::kResourceExhausted:
    case absl::StatusCode::kUnavailable:
    case absl::StatusCode::kUnauthenticated:
    case absl::StatusCode::kPermissionDenied:
      return LogLevel::kWarning;
    default:
      return LogLevel::kInfo;
  }
}

void AddText(LogFields& fields, const char* key, const std::string& value) {
  if (!value.empty()) fields.emplace_back(key, value);
}

// The keys that log and audit log share; those that say nothing are left out.
LogFields FieldsOf(const CallRecord& record) {
  LogFields fields = {{"method", std::string(record.method)},
                      {"code", absl::StatusCodeToString(record.code)}};
  AddText(fields, "reason", record.reason);
  AddText(fields, "resource", record.resource);
  AddText(fields, "principal", record.principal);
  AddText(fields, "peer", record.peer);
  AddText(fields, "trace_id", record.trace.trace_id);
  AddText(fields, "request_id", record.request_id);
  fields.emplace_back("elapsed_ms",
                      absl::ToDoubleMilliseconds(record.end - record.begin));
  return fields;
}

}  // namespace

absl::StatusOr<std::unique_ptr<Telemetry>> Telemetry::Open(
    const TelemetryOptions& options, std::ostream& log) {
  std::unique_ptr<Telemetry> telemetry(new Telemetry(log, options.log_level));
  if (!options.audit_log.empty()) {
    ARGMESH_ASSIGN_OR_RETURN(
        telemetry->audit_,
        LineFile::Open(options.audit_log, options.max_log_bytes));
  }
  if (!options.trace_log.empty()) {
    ARGMESH_ASSIGN_OR_RETURN(
        std::unique_ptr<LineFile> file,
        LineFile::Open(options.trace_log, options.max_log_bytes));
    telemetry->spans_ = std::make_unique<SpanLog>(std::move(file));
  }
  return telemetry;
}

void Telemetry::CallFinished(const CallRecord& record) {
  metrics_.Finished(record);
  if (spans_ != nullptr) spans_->Write(record);
  Audit(record);
  const LogLevel level = LevelOf(record.code);
  if (!log_.Takes(level)) return;
  LogFields fields = FieldsOf(record);
  AddText(fields, "error", record.internals);
  log_.Write(level, "call", fields);
}

void Telemetry::ItemFinished(const CallRecord& record) {
  metrics_.ItemFinished(record.reason);
  Audit(record);
  const LogLevel level = LevelOf(record.code);
  if (!log_.Takes(level)) return;
  LogFields fields = FieldsOf(record);
  AddText(fields, "error", record.internals);
  log_.Write(level, "item", fields);
}

void Telemetry::Audit(const CallRecord& record) {
  if (audit_ == nullptr || !(record.writes || IsDenial(record.code))) return;
  LogFields fields = {{"ts", LogTime(record.end)}};
  const LogFields rest = FieldsOf(record);
  fields.insert(fields.end(), rest.begin(), rest.end());
  audit_->Write(LogLine(fields));
}

absl::Status Telemetry::Reopen() {
  absl::Status status;
  if (audit_ != nullptr) status.Update(audit_->Reopen());
  if (spans_ != nullptr) status.Update(spans_->file().Reopen());
  return status;
}

void Telemetry::WriteGauges(GaugeSheet& sheet) const {
  const auto write = [&sheet](const char* file, int64_t dropped) {
    sheet.Counter("argmesh_log_lines_dropped_total",
                  "Lines that could not be written to a log file.",
                  static_cast<double>(dropped), {{"file", file}});
  };
  if (audit_ != nullptr) write("audit", audit_->dropped());
  if (spans_ != nullptr) write("trace", spans_->file().dropped());
}

}  // namespace argmesh
