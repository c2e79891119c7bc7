#include "server/telemetry/span_log.h"

#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"

namespace argmesh {
namespace {

using Json = nlohmann::ordered_json;

// Numbers of opentelemetry.proto.trace.v1.
constexpr int kSpanKindInternal = 1;
constexpr int kSpanKindServer = 2;
constexpr int kStatusError = 2;

Json Attribute(const char* key, const std::string& value) {
  return {{"key", key}, {"value", {{"stringValue", value}}}};
}

Json IntAttribute(const char* key, int64_t value) {
  return {{"key", key}, {"value", {{"intValue", absl::StrCat(value)}}}};
}

// 64-bit numbers are text in protobuf's JSON.
std::string Nanos(absl::Time time) {
  return absl::StrCat(absl::ToUnixNanos(time));
}

Json Span(const std::string& trace, const std::string& id,
          const std::string& parent, const std::string& name, absl::Time begin,
          absl::Time end) {
  Json span = {{"traceId", trace}, {"spanId", id}};
  if (!parent.empty()) span["parentSpanId"] = parent;
  span["name"] = name;
  span["kind"] = kSpanKindInternal;
  span["startTimeUnixNano"] = Nanos(begin);
  span["endTimeUnixNano"] = Nanos(end);
  return span;
}

Json ServerSpan(const CallRecord& record, const std::string& trace,
                const std::string& id) {
  const MethodName name = FullName(record.method);
  Json span = Span(trace, id, record.trace.parent_id,
                   absl::StrCat(name.service, "/", name.method), record.begin,
                   record.end);
  span["kind"] = kSpanKindServer;
  span["attributes"] = {
      Attribute("rpc.system", "grpc"),
      Attribute("rpc.service", name.service),
      Attribute("rpc.method", name.method),
      IntAttribute("rpc.grpc.status_code", static_cast<int>(record.code)),
      Attribute("network.peer.address", record.peer),
  };
  if (!record.reason.empty()) {
    span["attributes"].push_back(
        Attribute("argmesh.error_reason", record.reason));
  }
  if (record.code != absl::StatusCode::kOk) {
    span["status"] = {{"code", kStatusError}};
  }
  return span;
}

}  // namespace

std::string SpanLine(const CallRecord& record) {
  const std::string trace =
      record.trace.empty() ? MakeTraceId() : record.trace.trace_id;
  const std::string id = MakeSpanId();
  Json spans = Json::array({ServerSpan(record, trace, id)});
  if (record.work_begin < record.end) {
    spans.push_back(Span(trace, MakeSpanId(), id, "queue", record.begin,
                         record.work_begin));
    spans.push_back(
        Span(trace, MakeSpanId(), id, "work", record.work_begin, record.end));
  }
  Json scope = {{"scope", {{"name", "argmeshd"}}}, {"spans", spans}};
  Json resource = {
      {"resource",
       {{"attributes", Json::array({Attribute("service.name", "argmeshd")})}}},
      {"scopeSpans", Json::array({scope})}};
  const Json line = {{"resourceSpans", Json::array({resource})}};
  return line.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace argmesh
