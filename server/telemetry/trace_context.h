// Where a call belongs in a distributed trace (W3C Trace Context, level 1).
#ifndef ARGMESH_SERVER_TELEMETRY_TRACE_CONTEXT_H_
#define ARGMESH_SERVER_TELEMETRY_TRACE_CONTEXT_H_

#include <string>
#include <string_view>

namespace argmesh {

struct TraceContext {
  std::string trace_id;   // 32 hexadecimal digits; empty: none
  std::string parent_id;  // 16 hexadecimal digits; empty: none
  bool sampled = true;    // false: the caller wants no spans

  bool empty() const { return trace_id.empty(); }
};

// Of the header `traceparent`: "00-<32>-<16>-<2>" in lower-case hexadecimal
// digits. Of a newer version the known part is read. Anything else gives an
// empty context, as the standard asks: a bad header fails no call.
TraceContext ParseTraceparent(std::string_view header);

// Random, never all zero.
std::string MakeTraceId();
std::string MakeSpanId();

}  // namespace argmesh

#endif  // ARGMESH_SERVER_TELEMETRY_TRACE_CONTEXT_H_
