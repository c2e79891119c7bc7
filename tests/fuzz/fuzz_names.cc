// What comes to the server as one line of text: resource names, page tokens,
// API keys, traceparent headers, addresses. Refused with a reason, or the same
// text comes out again.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/access/api_key.h"
#include "server/engine/error_reason.h"
#include "server/engine/page_token.h"
#include "server/rpc/access_control.h"
#include "server/rpc/listen_address.h"
#include "server/rpc/resource_name.h"
#include "server/telemetry/trace_context.h"
#include "tests/fuzz/require.h"

namespace argmesh {
namespace {

void FuzzResourceNames(std::string_view text) {
  const auto collection = ParseCollectionName("name", text);
  Require(collection.ok() ? CollectionName(*collection) == text
                          : ReasonOf(collection.status()).has_value(),
          "collection name");
  const auto shape = ParseShapeName("name", text);
  Require(shape.ok() ? ShapeName(shape->collection, shape->id) == text
                     : ReasonOf(shape.status()).has_value(),
          "shape name");
  const auto snapshot = ParseSnapshotName("name", text);
  Require(snapshot.ok() ? SnapshotName(*snapshot) == text
                        : ReasonOf(snapshot.status()).has_value(),
          "snapshot name");
  const auto operation = ParseOperationName("name", text);
  Require(operation.ok() ? OperationName(*operation) == text
                         : ReasonOf(operation.status()).has_value(),
          "operation name");
}

void FuzzPageToken(std::string_view text) {
  const auto last = ParsePageToken("shapes/c", text);
  if (!last.ok()) {
    Require(ReasonOf(last.status()) == ErrorReason::kPageTokenInvalid,
            "page token");
  } else if (!last->empty()) {
    const auto again =
        ParsePageToken("shapes/c", MakePageToken("shapes/c", *last));
    Require(again.ok() && *again == *last, "page token");
    Require(!ParsePageToken("shapes/d", text).ok(), "a token of another list");
  }
}

void FuzzKey(std::string_view text) {
  (void)ParseKeyText(text);
  const auto caller = CallerOfBearer({}, text, absl::UnixEpoch());
  Require(ReasonOf(caller.status()) == ErrorReason::kKeyInvalid ||
              ReasonOf(caller.status()) == ErrorReason::kKeyMissing,
          "nobody has a key");
}

void FuzzTraceparent(std::string_view text) {
  const TraceContext trace = ParseTraceparent(text);
  Require(trace.empty() ||
              (trace.trace_id.size() == 32 && trace.parent_id.size() == 16),
          "traceparent");
}

void FuzzAddress(std::string_view text) {
  const auto address = ParseListenAddress(text);
  if (!address.ok()) return;
  const auto again = ParseListenAddress(address->ToString());
  Require(again.ok() && again->host == address->host &&
              again->port == address->port &&
              again->loopback == address->loopback,
          "address");
}

}  // namespace
}  // namespace argmesh

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  argmesh::FuzzResourceNames(text);
  argmesh::FuzzPageToken(text);
  argmesh::FuzzKey(text);
  argmesh::FuzzTraceparent(text);
  argmesh::FuzzAddress(text);
  return 0;
}
