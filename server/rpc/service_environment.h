// What every service of one server shares.
#ifndef ARGMESH_SERVER_RPC_SERVICE_ENVIRONMENT_H_
#define ARGMESH_SERVER_RPC_SERVICE_ENVIRONMENT_H_

#include <atomic>
#include <cstdint>
#include <string>

#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "server/engine/engine.h"
#include "server/engine/operation_store.h"
#include "server/engine/request_rules.h"
#include "server/engine/store_admin.h"
#include "server/rpc/access_control.h"
#include "server/rpc/admission.h"
#include "server/rpc/answer_room.h"
#include "server/rpc/call_registry.h"
#include "server/rpc/connection_calls.h"
#include "server/rpc/operation_registry.h"
#include "server/rpc/peer_budget.h"
#include "server/telemetry/telemetry.h"

namespace argmesh {

// Of one message, both ways; and of what the server puts into one.
inline constexpr int kMaxMessageBytes = 4 << 20;
inline constexpr int64_t kMaxAnswerBytes = 3 << 20;

// Of all answers together that are made and not taken, and of one connection's
// before it gets more; of all requests that wait until it does; of all that do
// not come whole promptly, each counted as a full message.
inline constexpr int64_t kMaxUnreadBytes = 128 << 20;
inline constexpr int64_t kMaxUnreadBytesOfAPeer = 1 << 20;
inline constexpr int64_t kMaxPostponedBytes = 64 << 20;
inline constexpr int64_t kMaxSlowRequestBytes = 256 << 20;

inline constexpr int kMaxPageSize = 1000;
inline constexpr int kMaxBatchSearches = 100;

struct ServiceLimits {
  int max_inflight_searches = 64;  // >= 1; also comparisons
  int max_inflight_uploads = 32;   // >= 1; CreateShape and UploadShape
  int max_inflight_ingests = 8;    // >= 1; streams
  // A call whose peer sends or takes no message for so long ends, and a stream
  // of meshes whose peer lags by so much (peer_pace.h); > 0.
  absl::Duration stream_idle_timeout = absl::Seconds(60);
  // What an ingest stream may have under way; each >= 1.
  int ingest_credit_items = 16;
  int64_t ingest_credit_bytes = 64 << 20;
};

struct ServiceEnvironment {
  ServiceEnvironment(Engine& the_engine, Telemetry& the_telemetry,
                     std::string the_version, const ServiceLimits& the_limits,
                     OperationStore* operation_store)
      : engine(the_engine),
        telemetry(the_telemetry),
        version(std::move(the_version)),
        limits(the_limits),
        stream_idle_ms(
            absl::ToInt64Milliseconds(the_limits.stream_idle_timeout)),
        searches("searches", the_limits.max_inflight_searches),
        query_streams("query streams", the_limits.max_inflight_searches),
        uploads("uploads", the_limits.max_inflight_uploads),
        ingests("ingest streams", the_limits.max_inflight_ingests),
        operations(the_telemetry.log(), operation_store) {}

  absl::Duration stream_idle_timeout() const {
    return absl::Milliseconds(stream_idle_ms.load());
  }
  // Of all but the credit of ingest streams; for the next calls.
  void SetLimits(const ServiceLimits& changed) {
    stream_idle_ms = absl::ToInt64Milliseconds(changed.stream_idle_timeout);
    searches.SetLimit(changed.max_inflight_searches);
    query_streams.SetLimit(changed.max_inflight_searches);
    uploads.SetLimit(changed.max_inflight_uploads);
    ingests.SetLimit(changed.max_inflight_ingests);
  }

  Engine& engine;
  Telemetry& telemetry;
  const std::string version;
  const absl::Time start_time = absl::Now();
  const ServiceLimits limits;
  std::atomic<int64_t> stream_idle_ms;  // as `limits`, until SetLimits
  Admission searches;
  Admission query_streams;  // StreamSearchShapes whose mesh is not there yet
  Admission uploads;
  Admission ingests;
  CallRegistry calls;
  ConnectionCalls connections;
  AnswerRoom answer_room{kMaxUnreadBytesOfAPeer};
  PeerBudget answers{kMaxUnreadBytes};
  PeerBudget postponed{kMaxPostponedBytes};
  PeerBudget requests{kMaxSlowRequestBytes};
  StoreAdmin* store_admin = nullptr;            // none: its rpcs are not served
  const ImportSource* import_source = nullptr;  // none: IMPORT_NOT_ENABLED
  OperationRegistry operations;
  AccessControl access;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_SERVICE_ENVIRONMENT_H_
