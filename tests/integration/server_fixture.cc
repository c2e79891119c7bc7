#include "tests/integration/server_fixture.h"

#include <google/protobuf/any.pb.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "server/storage/data_directory.h"
#include "server/storage/directory_mesh_store.h"
#include "server/storage/sqlite_catalog.h"
#include "tests/support/test_meshes.h"

namespace argmesh {
namespace {

constexpr int kVertexBudget = 300;

std::string OffOf(const TriangleMesh& mesh) {
  std::string text =
      absl::StrCat("OFF\n", mesh.V.rows(), " ", mesh.F.rows(), " 0\n");
  for (Eigen::Index v = 0; v < mesh.V.rows(); ++v) {
    absl::StrAppend(&text, mesh.V(v, 0), " ", mesh.V(v, 1), " ", mesh.V(v, 2),
                    "\n");
  }
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f) {
    absl::StrAppend(&text, "3 ", mesh.F(f, 0), " ", mesh.F(f, 1), " ",
                    mesh.F(f, 2), "\n");
  }
  return text;
}

}  // namespace

TestServer::TestServer(TestServerOptions options)
    : options_(std::move(options)) {
  auto telemetry = Telemetry::Open(options_.telemetry, log_text_);
  EXPECT_TRUE(telemetry.ok()) << telemetry.status();
  telemetry_ = *std::move(telemetry);
  options_.rpc.listen = "127.0.0.1:0";
  options_.rpc.version = "test";
}

TestServer::~TestServer() { Stop(absl::ZeroDuration()); }

void TestServer::OpenEngine() {
  auto directory = DataDirectory::Open(folder(), options_.directory);
  ASSERT_TRUE(directory.ok()) << directory.status();
  auto meshes = DirectoryMeshStore::Open(*directory);
  ASSERT_TRUE(meshes.ok()) << meshes.status();
  auto snapshots = SnapshotDirectory::Open(*directory, **meshes);
  ASSERT_TRUE(snapshots.ok()) << snapshots.status();
  auto catalog = SqliteCatalog::Open(*directory);
  ASSERT_TRUE(catalog.ok()) << catalog.status();
  auto engine =
      Engine::Create(options_.engine, *std::move(catalog), *std::move(meshes));
  ASSERT_TRUE(engine.ok()) << engine.status();
  engine_ = *std::move(engine);
  snapshots_ = *std::move(snapshots);
  options_.rpc.store_admin = snapshots_.get();
}

void TestServer::Start() {
  ASSERT_NO_FATAL_FAILURE(OpenEngine());
  auto rpc = RpcServer::Start(options_.rpc, *engine_, *telemetry_);
  ASSERT_TRUE(rpc.ok()) << rpc.status();
  rpc_ = *std::move(rpc);
  const absl::Status serving =
      engine_->WaitUntilServing(StopToken({}, absl::Now() + absl::Seconds(30)));
  ASSERT_TRUE(serving.ok()) << serving;
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  channel_ = grpc::CreateCustomChannel(
      rpc_->address(), grpc::InsecureChannelCredentials(), arguments);
  collections_ = v1::CollectionService::NewStub(channel_);
  shapes_ = v1::ShapeService::NewStub(channel_);
  ingest_ = v1::IngestService::NewStub(channel_);
  search_ = v1::SearchService::NewStub(channel_);
  admin_ = v1::AdminService::NewStub(channel_);
  operations_ = google::longrunning::Operations::NewStub(channel_);
}

void TestServer::Restart() {
  Stop(absl::Seconds(10));
  Start();
}

bool TestServer::Stop(absl::Duration grace) {
  bool clean = true;
  if (rpc_ != nullptr) clean = rpc_->Shutdown(absl::Now() + grace);
  rpc_.reset();
  if (engine_ != nullptr) {
    const absl::Status closed = engine_->Close();
    EXPECT_TRUE(closed.ok()) << closed;
  }
  snapshots_.reset();
  engine_.reset();
  return clean;
}

void TestServer::MakeCollection(const std::string& id, bool store_meshes) {
  v1::CreateCollectionRequest request;
  request.set_collection_id(id);
  v1::CollectionSettings& settings =
      *request.mutable_collection()->mutable_settings();
  settings.set_vertex_budget(kVertexBudget);
  settings.set_store_meshes(store_meshes);
  grpc::ClientContext context;
  v1::Collection response;
  ASSERT_CALL_OK(collections().CreateCollection(&context, request, &response));
}

v1::Shape TestServer::AddShape(
    const std::string& collection, const std::string& id,
    const std::string& off,
    const std::map<std::string, std::string>& metadata) {
  v1::CreateShapeRequest request;
  request.mutable_shape()->mutable_metadata()->insert(metadata.begin(),
                                                      metadata.end());
  request.set_parent("collections/" + collection);
  request.set_shape_id(id);
  request.mutable_mesh()->set_format(v1::MESH_FORMAT_OFF);
  request.mutable_mesh()->set_data(off);
  grpc::ClientContext context;
  v1::Shape response;
  const grpc::Status status =
      shapes().CreateShape(&context, request, &response);
  EXPECT_TRUE(status.ok()) << ErrorOf(status);
  return response;
}

void TestServer::DeclareKey(const std::string& collection,
                            const std::string& key, v1::MetadataType type) {
  v1::UpdateCollectionRequest request;
  request.mutable_collection()->set_name("collections/" + collection);
  v1::MetadataKey& declared =
      *request.mutable_collection()->add_metadata_keys();
  declared.set_key(key);
  declared.set_type(type);
  grpc::ClientContext context;
  v1::Collection response;
  const grpc::Status status =
      collections().UpdateCollection(&context, request, &response);
  EXPECT_TRUE(status.ok()) << ErrorOf(status);
}

ErrorOf::ErrorOf(const grpc::Status& status) {
  google::rpc::Status details;
  details.ParseFromString(status.error_details());
  *this = ErrorOf(details);
  code = status.error_code();
}

ErrorOf::ErrorOf(const google::rpc::Status& status)
    : code(static_cast<grpc::StatusCode>(status.code())) {
  for (const google::protobuf::Any& any : status.details()) {
    google::rpc::ErrorInfo info;
    google::rpc::RetryInfo retry;
    google::rpc::QuotaFailure quota;
    google::rpc::ResourceInfo resource;
    google::rpc::BadRequest bad;
    if (any.UnpackTo(&info)) {
      reason = info.reason();
      domain = info.domain();
      metadata = {info.metadata().begin(), info.metadata().end()};
    } else if (any.UnpackTo(&retry)) {
      has_retry = true;
    } else if (any.UnpackTo(&quota)) {
      has_quota = true;
    } else if (any.UnpackTo(&resource)) {
      resource_name = resource.resource_name();
    } else if (any.UnpackTo(&bad)) {
      bad_field = bad.field_violations(0).field();
    }
  }
}

std::ostream& operator<<(std::ostream& out, const ErrorOf& error) {
  out << "code " << error.code << " " << error.domain << "/" << error.reason;
  for (const auto& [key, value] : error.metadata) {
    out << " " << key << "=" << value;
  }
  return out;
}

std::string TorusOff(double minor_radius) {
  return OffOf(MakeTorus(1.0, minor_radius, 24, 12));
}

std::string DumbbellOff() { return OffOf(MakeDumbbell(16)); }

std::string SphereOff(int segments) {
  std::vector<Eigen::Vector2d> profile;
  for (int i = 1; i < segments; ++i) {
    const double angle = std::numbers::pi * i / segments;
    profile.emplace_back(-std::cos(angle), std::sin(angle));
  }
  return OffOf(MakeRevolution(profile, segments));
}

}  // namespace argmesh
