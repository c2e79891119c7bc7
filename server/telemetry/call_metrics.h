// Counters and histograms of calls, for Prometheus (docs/operations.md).
//
// Names and labels of the first four are those of go-grpc-prometheus, so that
// dashboards made for it fit. Thread-safe.
#ifndef ARGMESH_SERVER_TELEMETRY_CALL_METRICS_H_
#define ARGMESH_SERVER_TELEMETRY_CALL_METRICS_H_

#include <prometheus/counter.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>

#include <memory>
#include <string_view>

#include "absl/status/status.h"
#include "absl/time/time.h"
#include "server/telemetry/call_record.h"

namespace argmesh {

class CallMetrics {
 public:
  CallMetrics();

  // `method` is "ShapeService.GetShape".
  void Started(std::string_view method);
  void Finished(const CallRecord& record);
  // One item of an ingest stream; `reason` is empty when it was stored.
  void ItemFinished(std::string_view reason);
  // One stage of a search; `mode` is "global" or "partial".
  void SearchStageFinished(std::string_view mode, std::string_view stage,
                           absl::Duration elapsed);

  std::shared_ptr<prometheus::Collectable> collectable() const {
    return registry_;
  }

 private:
  const std::shared_ptr<prometheus::Registry> registry_;
  prometheus::Family<prometheus::Counter>& started_;
  prometheus::Family<prometheus::Counter>& handled_;
  prometheus::Family<prometheus::Histogram>& handling_;
  prometheus::Family<prometheus::Histogram>& queueing_;
  prometheus::Family<prometheus::Counter>& errors_;
  prometheus::Family<prometheus::Counter>& items_;
  prometheus::Family<prometheus::Histogram>& search_stages_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_TELEMETRY_CALL_METRICS_H_
