#include "server/telemetry/metrics_endpoint.h"

#include <prometheus/collectable.h>
#include <prometheus/exposer.h>
#include <prometheus/metric_family.h>

#include <exception>
#include <mutex>
#include <utility>

#include "absl/strings/str_format.h"

namespace argmesh {
namespace {

constexpr size_t kThreads = 1;

prometheus::MetricFamily ToFamily(const std::string& name,
                                  const GaugeSheet::Family& family) {
  const bool counter = family.kind == GaugeSheet::Kind::kCounter;
  prometheus::MetricFamily out;
  out.name = name;
  out.help = family.help;
  out.type =
      counter ? prometheus::MetricType::Counter : prometheus::MetricType::Gauge;
  for (const GaugeSheet::Sample& sample : family.samples) {
    prometheus::ClientMetric metric;
    for (const auto& [key, value] : sample.labels) {
      metric.label.push_back({key, value});
    }
    (counter ? metric.counter.value : metric.gauge.value) = sample.value;
    out.metric.push_back(std::move(metric));
  }
  return out;
}

class GaugeCollectable : public prometheus::Collectable {
 public:
  explicit GaugeCollectable(std::vector<GaugeSource> sources)
      : sources_(std::move(sources)) {}

  std::vector<prometheus::MetricFamily> Collect() const override {
    const std::lock_guard lock(mutex_);
    GaugeSheet sheet;
    for (const GaugeSource& source : sources_) source(sheet);
    std::vector<prometheus::MetricFamily> families;
    for (const auto& [name, family] : sheet.families()) {
      families.push_back(ToFamily(name, family));
    }
    return families;
  }

 private:
  mutable std::mutex mutex_;
  const std::vector<GaugeSource> sources_;
};

}  // namespace

struct MetricsEndpoint::Parts {
  std::shared_ptr<prometheus::Collectable> gauges;
  std::shared_ptr<prometheus::Collectable> calls;
  std::unique_ptr<prometheus::Exposer> exposer;  // goes first
};

absl::StatusOr<std::unique_ptr<MetricsEndpoint>> MetricsEndpoint::Start(
    const std::string& listen, const CallMetrics& calls,
    std::vector<GaugeSource> sources) {
  auto parts = std::make_unique<Parts>();
  parts->gauges = std::make_shared<GaugeCollectable>(std::move(sources));
  parts->calls = calls.collectable();
  try {
    parts->exposer = std::make_unique<prometheus::Exposer>(listen, kThreads);
    parts->exposer->RegisterCollectable(parts->calls);
    parts->exposer->RegisterCollectable(parts->gauges);
  } catch (const std::exception& error) {
    return absl::UnavailableError(absl::StrFormat(
        "cannot serve metrics on %s: %s", listen, error.what()));
  }
  return std::unique_ptr<MetricsEndpoint>(
      new MetricsEndpoint(std::move(parts)));
}

MetricsEndpoint::MetricsEndpoint(std::unique_ptr<Parts> parts)
    : parts_(std::move(parts)) {}

MetricsEndpoint::~MetricsEndpoint() = default;

int MetricsEndpoint::port() const {
  return parts_->exposer->GetListeningPorts().front();
}

}  // namespace argmesh
