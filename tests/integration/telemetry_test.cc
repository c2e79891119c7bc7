// What a running server tells of its calls: metrics, audit log, spans, and new
// limits while it runs.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "server/telemetry/engine_gauges.h"
#include "tests/integration/server_fixture.h"
#include "tests/support/temporary_directory.h"

namespace argmesh {
namespace {

using Json = nlohmann::json;

constexpr char kTrace[] = "0af7651916cd43dd8448eb211c80319c";

std::vector<Json> LinesOf(const std::string& path) {
  std::ifstream in(path);
  std::vector<Json> lines;
  for (std::string line; std::getline(in, line);) {
    lines.push_back(Json::parse(line));
  }
  return lines;
}

class ServerTelemetryTest : public ::testing::Test {
 protected:
  ServerTelemetryTest() {
    TestServerOptions options;
    options.telemetry.audit_log = Path("audit");
    options.telemetry.trace_log = Path("spans");
    options.telemetry.log_level = LogLevel::kDebug;
    server_ = std::make_unique<TestServer>(options);
    server_->Start();
  }

  std::string Path(const std::string& name) const {
    return folder_.path() / name;
  }

  grpc::Status GetShape(const std::string& traceparent = "") {
    grpc::ClientContext context;
    if (!traceparent.empty()) context.AddMetadata("traceparent", traceparent);
    v1::GetShapeRequest request;
    request.set_name("collections/parts/shapes/torus");
    v1::Shape shape;
    return server_->shapes().GetShape(&context, request, &shape);
  }

  const TemporaryDirectory folder_;
  std::unique_ptr<TestServer> server_;
};

TEST_F(ServerTelemetryTest, AuditsWhatChangesTheStore) {
  server_->MakeCollection("parts");
  server_->AddShape("parts", "torus", TorusOff());
  ASSERT_CALL_OK(GetShape());
  const std::vector<Json> audit = LinesOf(Path("audit"));
  ASSERT_EQ(audit.size(), 2U);
  EXPECT_EQ(audit[0]["method"], "CollectionService.CreateCollection");
  EXPECT_EQ(audit[0]["resource"], "collections/parts");
  EXPECT_EQ(audit[0]["code"], "OK");
  EXPECT_EQ(audit[1]["method"], "ShapeService.CreateShape");
  EXPECT_EQ(audit[1]["resource"], "collections/parts");
}

TEST_F(ServerTelemetryTest, ContinuesTheCallersTrace) {
  EXPECT_FALSE(
      GetShape(std::string("00-") + kTrace + "-b7ad6b7169203331-01").ok());
  const std::vector<Json> lines = LinesOf(Path("spans"));
  ASSERT_EQ(lines.size(), 1U);
  const Json& span = lines[0]["resourceSpans"][0]["scopeSpans"][0]["spans"][0];
  EXPECT_EQ(span["traceId"], kTrace);
  EXPECT_EQ(span["name"], "argmesh.v1.ShapeService/GetShape");
  EXPECT_EQ(span["status"]["code"], 2);
  EXPECT_NE(server_->log().find(kTrace), std::string::npos);
}

TEST_F(ServerTelemetryTest, ShowsIndexAndStoreAsGauges) {
  server_->MakeCollection("parts");
  server_->AddShape("parts", "torus", TorusOff());
  GaugeSheet sheet;
  WriteEngineGauges(server_->engine(), sheet);
  server_->rpc().WriteGauges(sheet);
  const auto value = [&sheet](const std::string& name) {
    const auto it = sheet.families().find(name);
    return it == sheet.families().end() ? -1 : it->second.samples[0].value;
  };
  EXPECT_EQ(value("argmesh_index_serving"), 1);
  EXPECT_EQ(value("argmesh_index_shapes"), 1);
  EXPECT_EQ(value("argmesh_index_collections"), 1);
  EXPECT_EQ(value("argmesh_store_meshes"), 1);
  EXPECT_EQ(value("argmesh_store_writable"), 1);
  EXPECT_GT(value("argmesh_store_mesh_bytes"), 1000);
  EXPECT_GT(value("argmesh_store_database_bytes"), 0);
  EXPECT_GT(value("argmesh_store_free_bytes"), 0);
  EXPECT_GE(value("argmesh_store_commits_total"), 2);
  EXPECT_GT(value("argmesh_store_commit_seconds_total"), 0);
  EXPECT_GT(value("argmesh_pool_threads"), 0);
  EXPECT_GT(value("argmesh_admission_limit"), 0);
  EXPECT_EQ(value("argmesh_draining"), 0);
}

TEST_F(ServerTelemetryTest, TakesNewLimitsWhileItRuns) {
  server_->MakeCollection("parts");
  ServiceLimits limits;
  limits.max_inflight_uploads = 0;
  server_->rpc().SetLimits(limits);
  v1::CreateShapeRequest request;
  request.set_parent("collections/parts");
  request.set_shape_id("torus");
  request.mutable_mesh()->set_data(TorusOff());
  v1::Shape shape;
  {
    grpc::ClientContext context;
    EXPECT_FAILS(server_->shapes().CreateShape(&context, request, &shape),
                 RESOURCE_EXHAUSTED, "OVERLOADED");
  }
  server_->rpc().SetLimits(ServiceLimits());
  grpc::ClientContext context;
  ASSERT_CALL_OK(server_->shapes().CreateShape(&context, request, &shape));
}

}  // namespace
}  // namespace argmesh
