// Metrics in Prometheus' text format over HTTP: GET /metrics.
//
// On an address of its own, apart from the service's: whoever reaches it reads
// names of collections and sizes, nothing else, and needs no key.
#ifndef ARGMESH_SERVER_TELEMETRY_METRICS_ENDPOINT_H_
#define ARGMESH_SERVER_TELEMETRY_METRICS_ENDPOINT_H_

#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "server/telemetry/call_metrics.h"
#include "server/telemetry/gauge_sheet.h"

namespace argmesh {

class MetricsEndpoint {
 public:
  // `listen` is HOST:PORT, port 0 takes a free one. `calls` and what the
  // sources use must outlive the endpoint. kUnavailable when the address
  // cannot be bound.
  static absl::StatusOr<std::unique_ptr<MetricsEndpoint>> Start(
      const std::string& listen, const CallMetrics& calls,
      std::vector<GaugeSource> sources);
  ~MetricsEndpoint();  // waits for a scrape that runs

  int port() const;

 private:
  struct Parts;
  explicit MetricsEndpoint(std::unique_ptr<Parts> parts);
  const std::unique_ptr<Parts> parts_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_TELEMETRY_METRICS_ENDPOINT_H_
