#include "server/telemetry/gauge_sheet.h"

namespace argmesh {

void GaugeSheet::Gauge(std::string_view name, std::string_view help,
                       double value, Labels labels) {
  Add(Kind::kGauge, name, help, {std::move(labels), value});
}

void GaugeSheet::Counter(std::string_view name, std::string_view help,
                         double value, Labels labels) {
  Add(Kind::kCounter, name, help, {std::move(labels), value});
}

void GaugeSheet::Add(Kind kind, std::string_view name, std::string_view help,
                     Sample sample) {
  auto it = families_.find(name);
  if (it == families_.end()) {
    it = families_
             .emplace(std::string(name), Family{kind, std::string(help), {}})
             .first;
  }
  it->second.samples.push_back(std::move(sample));
}

}  // namespace argmesh
