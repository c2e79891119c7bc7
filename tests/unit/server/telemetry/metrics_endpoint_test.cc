#include "server/telemetry/metrics_endpoint.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>

#include "server/telemetry/engine_gauges.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string Get(int port, const std::string& path) {
  const int peer = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (connect(peer, reinterpret_cast<const sockaddr*>(&address),
              sizeof(address)) != 0) {
    return "cannot connect";
  }
  const std::string request =
      "GET " + path + " HTTP/1.0\r\nHost: localhost\r\n\r\n";
  EXPECT_EQ(write(peer, request.data(), request.size()),
            static_cast<ssize_t>(request.size()));
  std::string answer;
  char buffer[4096];
  ssize_t count = 0;
  while ((count = read(peer, buffer, sizeof(buffer))) > 0) {
    answer.append(buffer, static_cast<size_t>(count));
  }
  close(peer);
  return answer;
}

CallRecord Ended(absl::StatusCode code, const std::string& reason) {
  CallRecord record;
  record.method = "SearchService.SearchShapes";
  record.code = code;
  record.reason = reason;
  record.begin = absl::FromUnixSeconds(1'700'000'000);
  record.work_begin = record.begin + absl::Milliseconds(20);
  record.end = record.begin + absl::Milliseconds(70);
  return record;
}

TEST(MetricsEndpoint, CountsCallsByMethodAndCode) {
  CallMetrics calls;
  calls.Started("SearchService.SearchShapes");
  calls.Started("SearchService.SearchShapes");
  calls.Finished(Ended(absl::StatusCode::kOk, ""));
  calls.Finished(Ended(absl::StatusCode::kNotFound, "COLLECTION_NOT_FOUND"));
  calls.ItemFinished("");
  calls.ItemFinished("MESH_EMPTY");
  calls.SearchStageFinished("partial", "match", absl::Milliseconds(20));
  auto endpoint = MetricsEndpoint::Start("127.0.0.1:0", calls, {});
  ASSERT_TRUE(endpoint.ok()) << endpoint.status();
  const std::string text = Get((*endpoint)->port(), "/metrics");
  const std::string labels =
      "grpc_method=\"SearchShapes\","
      "grpc_service=\"argmesh.v1.SearchService\"";
  EXPECT_THAT(text, HasSubstr("grpc_server_started_total{" + labels + "} 2"));
  EXPECT_THAT(text, HasSubstr("grpc_server_handled_total{grpc_code=\"OK\"," +
                              labels + "} 1"));
  EXPECT_THAT(text,
              HasSubstr("grpc_server_handled_total{grpc_code=\"NOT_FOUND\"," +
                        labels + "} 1"));
  EXPECT_THAT(
      text, HasSubstr("grpc_server_handling_seconds_count{" + labels + "} 2"));
  EXPECT_THAT(text, HasSubstr("grpc_server_handling_seconds_bucket{" + labels +
                              ",le=\"0.05\"} 0"));
  EXPECT_THAT(text, HasSubstr("grpc_server_handling_seconds_bucket{" + labels +
                              ",le=\"0.1\"} 2"));
  EXPECT_THAT(text, HasSubstr("argmesh_queue_wait_seconds_bucket{" + labels +
                              ",le=\"0.025\"} 2"));
  EXPECT_THAT(text, HasSubstr("argmesh_errors_total{reason="
                              "\"COLLECTION_NOT_FOUND\"} 1"));
  EXPECT_THAT(text, HasSubstr("argmesh_ingest_items_total{reason=\"\"} 1"));
  EXPECT_THAT(text, HasSubstr("{reason=\"MESH_EMPTY\"} 1"));
  EXPECT_THAT(text, HasSubstr("argmesh_search_stage_seconds_bucket{mode="
                              "\"partial\",stage=\"match\",le=\"0.025\"} 1"));
}

TEST(MetricsEndpoint, NamesOperationsByTheirOwnPackage) {
  CallMetrics calls;
  calls.Started("Operations.ListOperations");
  auto endpoint = MetricsEndpoint::Start("127.0.0.1:0", calls, {});
  ASSERT_TRUE(endpoint.ok()) << endpoint.status();
  EXPECT_THAT(Get((*endpoint)->port(), "/metrics"),
              HasSubstr("grpc_service=\"google.longrunning.Operations\"} 1"));
}

TEST(MetricsEndpoint, ReadsGaugesWhenItIsAsked) {
  const CallMetrics calls;
  double depth = 3;
  auto endpoint = MetricsEndpoint::Start(
      "127.0.0.1:0", calls, {[&depth](GaugeSheet& sheet) {
        sheet.Gauge("depth", "How deep.", depth, {{"pool", "quick"}});
        sheet.Gauge("depth", "", depth + 1, {{"pool", "search"}});
        sheet.Counter("done_total", "How much.", 7);
      }});
  ASSERT_TRUE(endpoint.ok()) << endpoint.status();
  const std::string before = Get((*endpoint)->port(), "/metrics");
  EXPECT_THAT(before, HasSubstr("# HELP depth How deep."));
  EXPECT_THAT(before, HasSubstr("# TYPE depth gauge"));
  EXPECT_THAT(before, HasSubstr("depth{pool=\"quick\"} 3"));
  EXPECT_THAT(before, HasSubstr("depth{pool=\"search\"} 4"));
  EXPECT_THAT(before, HasSubstr("# TYPE done_total counter"));
  depth = 8;
  EXPECT_THAT(Get((*endpoint)->port(), "/metrics"),
              HasSubstr("depth{pool=\"quick\"} 8"));
}

TEST(MetricsEndpoint, ShowsTheProcess) {
  const CallMetrics calls;
  auto endpoint =
      MetricsEndpoint::Start("127.0.0.1:0", calls, {WriteProcessGauges});
  ASSERT_TRUE(endpoint.ok()) << endpoint.status();
  const std::string text = Get((*endpoint)->port(), "/metrics");
  for (const char* name :
       {"process_resident_memory_bytes", "process_cpu_seconds_total",
        "process_open_fds", "process_start_time_seconds"}) {
    EXPECT_THAT(text, HasSubstr(std::string("\n") + name + " "));
  }
  EXPECT_THAT(text, Not(HasSubstr("process_resident_memory_bytes 0\n")));
}

TEST(MetricsEndpoint, ServesNothingElse) {
  const CallMetrics calls;
  auto endpoint = MetricsEndpoint::Start("127.0.0.1:0", calls, {});
  ASSERT_TRUE(endpoint.ok()) << endpoint.status();
  EXPECT_THAT(Get((*endpoint)->port(), "/"), HasSubstr(" 404 "));
}

TEST(MetricsEndpoint, RefusesAnAddressThatIsTaken) {
  const CallMetrics calls;
  auto first = MetricsEndpoint::Start("127.0.0.1:0", calls, {});
  ASSERT_TRUE(first.ok()) << first.status();
  const auto second = MetricsEndpoint::Start(
      "127.0.0.1:" + std::to_string((*first)->port()), calls, {});
  EXPECT_EQ(second.status().code(), absl::StatusCode::kUnavailable);
}

}  // namespace
}  // namespace argmesh
