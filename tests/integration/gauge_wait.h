// Reading a server's gauges, and waiting for them.
#ifndef ARGMESH_TESTS_INTEGRATION_GAUGE_WAIT_H_
#define ARGMESH_TESTS_INTEGRATION_GAUGE_WAIT_H_

#include <gmock/gmock.h>

#include <string>

#include "absl/time/clock.h"
#include "server/telemetry/gauge_sheet.h"
#include "tests/integration/server_fixture.h"

namespace argmesh {

// The sample labelled `label`, the first when it is empty.
inline double GaugeOf(TestServer& server, const std::string& name,
                      const std::string& label = "") {
  GaugeSheet sheet;
  server.rpc().WriteGauges(sheet);
  for (const auto& sample : sheet.families().at(name).samples) {
    if (label.empty() || sample.labels.at(0).second == label) {
      return sample.value;
    }
  }
  ADD_FAILURE() << name << " has no " << label;
  return 0;
}

// Until it is what `matcher` asks for, 20 s at most.
template <typename Matcher>
void WaitForGauge(TestServer& server, const std::string& name,
                  const Matcher& matcher, const std::string& label = "") {
  const absl::Time end = absl::Now() + absl::Seconds(20);
  while (!testing::Value(GaugeOf(server, name, label), matcher) &&
         absl::Now() < end) {
    absl::SleepFor(absl::Milliseconds(5));
  }
  EXPECT_THAT(GaugeOf(server, name, label), matcher) << name << " " << label;
}

}  // namespace argmesh

#endif  // ARGMESH_TESTS_INTEGRATION_GAUGE_WAIT_H_
