// Values that are read when they are asked for: depths, sizes, states.
#ifndef ARGMESH_SERVER_TELEMETRY_GAUGE_SHEET_H_
#define ARGMESH_SERVER_TELEMETRY_GAUGE_SHEET_H_

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace argmesh {

// What one scrape collects. Belongs to one thread.
class GaugeSheet {
 public:
  enum class Kind { kGauge, kCounter };
  using Labels = std::vector<std::pair<std::string, std::string>>;

  struct Sample {
    Labels labels;
    double value = 0;
  };
  struct Family {
    Kind kind = Kind::kGauge;
    std::string help;
    std::vector<Sample> samples;
  };

  // `name` as docs/operations.md lists it; `help` counts the first time.
  void Gauge(std::string_view name, std::string_view help, double value,
             Labels labels = {});
  // Only ever grows, from 0 at the start of the process.
  void Counter(std::string_view name, std::string_view help, double value,
               Labels labels = {});

  const std::map<std::string, Family, std::less<>>& families() const {
    return families_;
  }

 private:
  void Add(Kind kind, std::string_view name, std::string_view help,
           Sample sample);

  std::map<std::string, Family, std::less<>> families_;
};

// Writes its values; called at every scrape, from any thread, never from two
// at once.
using GaugeSource = std::function<void(GaugeSheet&)>;

}  // namespace argmesh

#endif  // ARGMESH_SERVER_TELEMETRY_GAUGE_SHEET_H_
