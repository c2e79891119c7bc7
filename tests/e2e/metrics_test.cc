// What a running server shows to Prometheus, and what is written about it: the
// manual lists every metric, and dashboard and alerts use none that is not
// there.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

#include "tests/e2e/installation.h"

namespace argmesh {
namespace {

std::string GetMetrics(int port) {
  const int peer = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  std::string answer;
  if (connect(peer, reinterpret_cast<const sockaddr*>(&address),
              sizeof(address)) == 0) {
    const std::string request =
        "GET /metrics HTTP/1.0\r\nHost: localhost\r\n\r\n";
    if (write(peer, request.data(), request.size()) > 0) {
      char buffer[4096];
      ssize_t count = 0;
      while ((count = read(peer, buffer, sizeof(buffer))) > 0) {
        answer.append(buffer, static_cast<size_t>(count));
      }
    }
  }
  close(peer);
  return answer;
}

std::set<std::string> AllOf(const std::string& text, const char* pattern) {
  const std::regex regex(pattern);
  std::set<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end;
       ++it) {
    found.insert((*it)[1]);
  }
  return found;
}

std::string SourceFile(const std::string& path) {
  std::ifstream in(std::string(ARGMESH_SOURCE_FOLDER) + "/" + path);
  EXPECT_TRUE(in) << path;
  return {std::istreambuf_iterator<char>(in), {}};
}

class MetricsTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(installation_.StartServer(
        {"--metrics-listen", "127.0.0.1:0", "--audit-log",
         (installation_.folder() / "audit").string()}));
    ASSERT_TRUE(installation_.WaitForLog("\"msg\":\"metrics\""));
    std::smatch match;
    const std::string log = installation_.ServerLog();
    ASSERT_TRUE(std::regex_search(
        log, match, std::regex("\"msg\":\"metrics\",\"port\":(\\d+)")));
    port_ = std::stoi(match[1]);
    // One of each: a stored item, a good call, a failed one.
    ASSERT_EQ(installation_
                  .Run({"sample", "--out", Path("meshes"), "--classes", "mug",
                        "--shapes-per-class", "1", "--vertices", "1500"})
                  .exit_code,
              0);
    ASSERT_EQ(
        installation_.Run({"ingest", "--collection", "mugs", Path("meshes")})
            .exit_code,
        0);
    ASSERT_EQ(installation_
                  .Run({"search", "--collection", "mugs",
                        Path("meshes/mug/mug-01.off")})
                  .exit_code,
              0);
    ASSERT_EQ(installation_.Run({"list", "--collection", "none"}).exit_code, 1);
    text_ = GetMetrics(port_);
  }

  std::string Path(const std::string& name) const {
    return (installation_.folder() / name).string();
  }
  std::set<std::string> Served() const {
    return AllOf(text_, "# TYPE ([a-z0-9_]+) ");
  }

  Installation installation_;
  int port_ = 0;
  std::string text_;
};

TEST_F(MetricsTest, FollowTheWorkOfTheServer) {
  EXPECT_NE(text_.find("argmesh_index_shapes{collection=\"mugs\"} 1"),
            std::string::npos);
  EXPECT_NE(text_.find("argmesh_ingest_items_total{reason=\"\"} 1"),
            std::string::npos);
  // The ingest asked for the collection before it made it.
  EXPECT_NE(
      text_.find("argmesh_errors_total{reason=\"COLLECTION_NOT_FOUND\"} 2"),
      std::string::npos);
}

TEST_F(MetricsTest, AreAllInTheManual) {
  const std::set<std::string> written =
      AllOf(SourceFile("docs/operations.md"), "`([a-z]+_[a-z0-9_]+)`");
  for (const std::string& name : Served()) {
    EXPECT_TRUE(written.contains(name)) << name << " is not in the manual";
  }
  for (const std::string& name : written) {
    if (!name.starts_with("argmesh_") && !name.starts_with("process_")) {
      continue;
    }
    EXPECT_TRUE(Served().contains(name)) << name << " is not served";
  }
}

TEST_F(MetricsTest, AreWhatDashboardAndAlertsAskFor) {
  const std::string text = SourceFile("docker/prometheus/alerts.yaml") +
                           SourceFile("docker/grafana/argmesh.json");
  const std::set<std::string> used = AllOf(
      text, "\\b((?:argmesh|grpc_server|process)_[a-z_]+[a-z])[\\[{ )\",]");
  EXPECT_GT(used.size(), 15U);
  for (std::string name : used) {
    for (const char* suffix : {"_bucket", "_count", "_sum"}) {
      if (name.ends_with(suffix)) name.erase(name.rfind(suffix));
    }
    EXPECT_TRUE(Served().contains(name)) << name << " is not served";
  }
}

TEST_F(MetricsTest, HaveAnAlertForEachInTheManual) {
  EXPECT_EQ(
      AllOf(SourceFile("docker/prometheus/alerts.yaml"), "alert: ([A-Za-z]+)"),
      AllOf(SourceFile("docs/operations.md"), "\n\\| (Argmesh[A-Za-z]+) \\|"));
}

}  // namespace
}  // namespace argmesh
