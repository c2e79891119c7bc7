// IngestService.ImportShapes: files of the server's own disk.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "core/base/identifier.h"
#include "server/storage/import_root.h"
#include "tests/integration/operation_wait.h"
#include "tests/integration/server_fixture.h"

namespace argmesh {
namespace {

using google::longrunning::Operation;

class ImportTest : public ::testing::Test {
 protected:
  ImportTest() {
    Write("ring.off", TorusOff());
    Write("Cups/Round.off", SphereOff());
    auto root = ImportRoot::Open(files_.path());
    EXPECT_TRUE(root.ok()) << root.status();
    root_ = *std::move(root);
    TestServerOptions options;
    options.rpc.import_source = root_.get();
    server_ = std::make_unique<TestServer>(options);
    server_->Start();
    server_->MakeCollection("c");
  }

  void Write(const std::string& name, const std::string& bytes) {
    const std::filesystem::path path = files_.path() / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << bytes;
  }

  static v1::ImportShapesRequest Request(const std::string& folder = "") {
    v1::ImportShapesRequest request;
    request.set_parent("collections/c");
    request.set_folder(folder);
    request.set_existing_shape_policy(
        v1::EXISTING_SHAPE_POLICY_ACCEPT_SAME_MESH);
    return request;
  }

  grpc::Status Start(const v1::ImportShapesRequest& request,
                     Operation* operation) {
    grpc::ClientContext context;
    return server_->ingest().ImportShapes(&context, request, operation);
  }

  Operation Import(const v1::ImportShapesRequest& request) {
    Operation operation;
    const grpc::Status status = Start(request, &operation);
    EXPECT_TRUE(status.ok()) << ErrorOf(status);
    return WaitForOperation(*server_, operation.name());
  }

  TemporaryDirectory files_;
  std::unique_ptr<ImportRoot> root_;
  std::unique_ptr<TestServer> server_;
};

TEST_F(ImportTest, StoresEveryFileUnderTheIdOfItsPath) {
  const Operation done = Import(Request());
  const auto response = ResponseOf<v1::ImportShapesResponse>(done);
  EXPECT_EQ(response.imported(), 2);
  EXPECT_EQ(response.already_stored(), 0);
  EXPECT_EQ(response.failed(), 0);
  EXPECT_EQ(MetadataOf(done).method(), "IngestService.ImportShapes");
  EXPECT_EQ(MetadataOf(done).resource(), "collections/c");
  EXPECT_EQ(MetadataOf(done).items(), 2);
  EXPECT_EQ(MetadataOf(done).items_done(), 2);
  for (const char* path : {"ring.off", "Cups/Round.off"}) {
    grpc::ClientContext context;
    v1::GetShapeRequest request;
    request.set_name("collections/c/shapes/" + IdentifierFromPath(path));
    v1::Shape shape;
    ASSERT_CALL_OK(server_->shapes().GetShape(&context, request, &shape));
    EXPECT_EQ(shape.source_uri(), path);
    EXPECT_EQ(shape.mesh().format(), v1::MESH_FORMAT_OFF);
    EXPECT_TRUE(shape.mesh().stored());
  }
}

TEST_F(ImportTest, StoresOnlyWhatIsNotThereYet) {
  Import(Request());
  Write("new.off", DumbbellOff());
  const auto again = ResponseOf<v1::ImportShapesResponse>(Import(Request()));
  EXPECT_EQ(again.imported(), 1);
  EXPECT_EQ(again.already_stored(), 2);
  EXPECT_EQ(again.failed(), 0);
}

TEST_F(ImportTest, NamesEachFileThatFailedAndStoresTheOthers) {
  Write("bad.off", "OFF\n1 1 0\n");
  std::filesystem::create_symlink("ring.off", files_.path() / "link.off");
  const auto response = ResponseOf<v1::ImportShapesResponse>(Import(Request()));
  EXPECT_EQ(response.imported(), 2);
  EXPECT_EQ(response.failed(), 2);
  ASSERT_EQ(response.failures_size(), 2);
  EXPECT_EQ(response.failures(0).path(), "bad.off");
  EXPECT_FAILS(response.failures(0).error(), INVALID_ARGUMENT,
               "MESH_MALFORMED");
  EXPECT_EQ(response.failures(1).path(), "link.off");
  EXPECT_FAILS(response.failures(1).error(), FAILED_PRECONDITION,
               "FILE_UNREADABLE");
}

TEST_F(ImportTest, DoesWithATakenIdWhatThePolicySays) {
  Import(Request());
  Write("ring.off", TorusOff(0.3));
  auto response = ResponseOf<v1::ImportShapesResponse>(Import(Request()));
  EXPECT_EQ(response.already_stored(), 1);
  ASSERT_EQ(response.failures_size(), 1);
  EXPECT_FAILS(response.failures(0).error(), ALREADY_EXISTS, "SHAPE_EXISTS");
  v1::ImportShapesRequest replace = Request();
  replace.set_existing_shape_policy(v1::EXISTING_SHAPE_POLICY_REPLACE);
  response = ResponseOf<v1::ImportShapesResponse>(Import(replace));
  EXPECT_EQ(response.imported(), 2);
}

TEST_F(ImportTest, ReadsNothingOutsideItsRoot) {
  for (const char* folder : {"..", "/", "/etc", "Cups/../..", "none"}) {
    const Operation done = Import(Request(folder));
    EXPECT_FAILS(done.error(), FAILED_PRECONDITION, "FILE_UNREADABLE");
  }
  const auto cups =
      ResponseOf<v1::ImportShapesResponse>(Import(Request("Cups")));
  EXPECT_EQ(cups.imported(), 1);
}

TEST_F(ImportTest, GoesOnWhereItWasCancelled) {
  for (int i = 0; i < 6; ++i) {
    Write("s" + std::to_string(i) + ".off", SphereOff(60 + i));
  }
  Operation operation;
  ASSERT_CALL_OK(Start(Request(), &operation));
  CancelOperation(*server_, operation.name());
  operation = WaitForOperation(*server_, operation.name());
  EXPECT_FAILS(operation.error(), CANCELLED, "CANCELLED");
  const int64_t done = MetadataOf(operation).items_done();
  EXPECT_LT(done, 8);
  server_->Restart();
  const auto response = ResponseOf<v1::ImportShapesResponse>(Import(Request()));
  EXPECT_EQ(response.already_stored(), done);
  EXPECT_EQ(response.imported(), 8 - done);
}

TEST_F(ImportTest, RefusesAnImportThatCannotBegin) {
  Operation operation;
  v1::ImportShapesRequest request = Request();
  request.set_parent("collections/none");
  EXPECT_FAILS(Start(request, &operation), NOT_FOUND, "COLLECTION_NOT_FOUND");
  request.set_parent("none");
  EXPECT_FAILS(Start(request, &operation), INVALID_ARGUMENT, "NAME_INVALID");
}

TEST(ImportWithoutARoot, IsRefusedWithItsReason) {
  TestServer server;
  server.Start();
  server.MakeCollection("c");
  grpc::ClientContext context;
  v1::ImportShapesRequest request;
  request.set_parent("collections/c");
  Operation operation;
  EXPECT_FAILS(server.ingest().ImportShapes(&context, request, &operation),
               FAILED_PRECONDITION, "IMPORT_NOT_ENABLED");
}

}  // namespace
}  // namespace argmesh
