// A whole server on a free loopback port with a folder of its own, and stubs
// for every service.
//
//   TestServer server;            // ASSERT_TRUE(server.Start());
//   grpc::ClientContext context;
//   server.shapes().GetShape(&context, request, &shape);
#ifndef ARGMESH_TESTS_INTEGRATION_SERVER_FIXTURE_H_
#define ARGMESH_TESTS_INTEGRATION_SERVER_FIXTURE_H_

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <memory>
#include <sstream>
#include <string>

#include "argmesh/v1/admin_service.grpc.pb.h"
#include "argmesh/v1/collection_service.grpc.pb.h"
#include "argmesh/v1/ingest_service.grpc.pb.h"
#include "argmesh/v1/search_service.grpc.pb.h"
#include "argmesh/v1/shape_service.grpc.pb.h"
#include "google/longrunning/operations.grpc.pb.h"
#include "server/engine/engine.h"
#include "server/rpc/rpc_server.h"
#include "server/storage/data_directory.h"
#include "server/storage/snapshot_directory.h"
#include "server/telemetry/telemetry.h"
#include "tests/support/temporary_directory.h"

namespace argmesh {

struct TestServerOptions {
  EngineOptions engine;
  RpcServerOptions rpc;
  TelemetryOptions telemetry;
  DataDirectoryOptions directory;
};

class TestServer {
 public:
  explicit TestServer(TestServerOptions options = {});
  ~TestServer();

  // Opens storage and engine, serves, and waits until searches are served.
  void Start();
  // Everything again from the same folder.
  void Restart();
  bool Stop(absl::Duration grace);

  RpcServer& rpc() { return *rpc_; }
  Engine& engine() { return *engine_; }
  Telemetry& telemetry() { return *telemetry_; }
  const std::filesystem::path& folder() const { return folder_.path(); }
  std::string log() const { return log_text_.str(); }
  std::shared_ptr<grpc::Channel> channel() { return channel_; }

  v1::CollectionService::Stub& collections() { return *collections_; }
  v1::ShapeService::Stub& shapes() { return *shapes_; }
  v1::IngestService::Stub& ingest() { return *ingest_; }
  v1::SearchService::Stub& search() { return *search_; }
  v1::AdminService::Stub& admin() { return *admin_; }
  google::longrunning::Operations::Stub& operations() { return *operations_; }

  // A collection of small samples, so that a shape takes little time.
  void MakeCollection(const std::string& id, bool store_meshes = true);
  // Through CreateShape.
  v1::Shape AddShape(const std::string& collection, const std::string& id,
                     const std::string& off,
                     const std::map<std::string, std::string>& metadata = {});
  // The one metadata key of the collection.
  void DeclareKey(const std::string& collection, const std::string& key,
                  v1::MetadataType type);

 private:
  void OpenEngine();

  TestServerOptions options_;
  TemporaryDirectory folder_;
  std::ostringstream log_text_;
  std::unique_ptr<Telemetry> telemetry_;
  std::unique_ptr<Engine> engine_;
  std::unique_ptr<SnapshotDirectory> snapshots_;  // uses the engine's meshes
  std::unique_ptr<RpcServer> rpc_;
  std::shared_ptr<grpc::Channel> channel_;
  std::unique_ptr<v1::CollectionService::Stub> collections_;
  std::unique_ptr<v1::ShapeService::Stub> shapes_;
  std::unique_ptr<v1::IngestService::Stub> ingest_;
  std::unique_ptr<v1::SearchService::Stub> search_;
  std::unique_ptr<v1::AdminService::Stub> admin_;
  std::unique_ptr<google::longrunning::Operations::Stub> operations_;
};

// The ErrorInfo of a failed call.
struct ErrorOf {
  explicit ErrorOf(const grpc::Status& status);
  explicit ErrorOf(const google::rpc::Status& status);

  grpc::StatusCode code = grpc::StatusCode::OK;
  std::string reason;
  std::string domain;
  std::map<std::string, std::string> metadata;
  bool has_retry = false;
  bool has_quota = false;
  std::string resource_name;
  std::string bad_field;
};

std::ostream& operator<<(std::ostream& out, const ErrorOf& error);

// OFF text of closed surfaces of a few hundred vertices.
std::string TorusOff(double minor_radius = 0.4);
std::string DumbbellOff();
std::string SphereOff(int segments = 20);

}  // namespace argmesh

// The call failed with this code and this reason.
#define EXPECT_FAILS(status, expected_code, expected_reason)             \
  do {                                                                   \
    const ::argmesh::ErrorOf error_{status};                             \
    EXPECT_EQ(error_.code, ::grpc::StatusCode::expected_code) << error_; \
    EXPECT_EQ(error_.reason, expected_reason) << error_;                 \
  } while (false)

#define ASSERT_CALL_OK(expr)                                  \
  do {                                                        \
    const ::grpc::Status status_ = (expr);                    \
    ASSERT_TRUE(status_.ok()) << ::argmesh::ErrorOf(status_); \
  } while (false)

#endif  // ARGMESH_TESTS_INTEGRATION_SERVER_FIXTURE_H_
