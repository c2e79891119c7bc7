// AdminService and Operations: snapshots, verification, and the work behind
// them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <thread>

#include "absl/time/clock.h"
#include "server/telemetry/gauge_sheet.h"
#include "tests/integration/operation_wait.h"
#include "tests/integration/server_fixture.h"
#include "tests/support/large_database.h"

namespace argmesh {
namespace {

using google::longrunning::Operation;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class AdminServiceTest : public ::testing::Test {
 protected:
  AdminServiceTest() {
    server_.Start();
    server_.MakeCollection("parts");
    server_.AddShape("parts", "torus", TorusOff());
  }

  grpc::Status StartSnapshot(const std::string& id, Operation* operation) {
    grpc::ClientContext context;
    v1::CreateSnapshotRequest request;
    request.set_snapshot_id(id);
    return server_.admin().CreateSnapshot(&context, request, operation);
  }

  Operation Wait(const std::string& name) {
    return WaitForOperation(server_, name);
  }

  v1::Snapshot MakeSnapshot(const std::string& id) {
    Operation operation;
    const grpc::Status status = StartSnapshot(id, &operation);
    EXPECT_TRUE(status.ok()) << ErrorOf(status);
    operation = Wait(operation.name());
    v1::Snapshot snapshot;
    EXPECT_TRUE(operation.response().UnpackTo(&snapshot))
        << operation.DebugString();
    return snapshot;
  }

  TestServer server_;
};

TEST_F(AdminServiceTest, MakesASnapshotInTheBackground) {
  Operation operation;
  ASSERT_CALL_OK(StartSnapshot("one", &operation));
  EXPECT_THAT(operation.name(), HasSubstr("operations/"));
  operation = Wait(operation.name());
  v1::OperationMetadata metadata;
  ASSERT_TRUE(operation.metadata().UnpackTo(&metadata));
  EXPECT_EQ(metadata.method(), "AdminService.CreateSnapshot");
  EXPECT_EQ(metadata.resource(), "snapshots/one");
  EXPECT_TRUE(metadata.has_end_time());
  v1::Snapshot snapshot;
  ASSERT_TRUE(operation.response().UnpackTo(&snapshot));
  EXPECT_EQ(snapshot.name(), "snapshots/one");
  EXPECT_GT(snapshot.size_bytes(), 10'000);
  EXPECT_EQ(snapshot.sha256().size(), 64U);
}

TEST_F(AdminServiceTest, SaysHowAnOperationFailed) {
  MakeSnapshot("one");
  Operation operation;
  ASSERT_CALL_OK(StartSnapshot("one", &operation));
  operation = Wait(operation.name());
  EXPECT_FAILS(operation.error(), ALREADY_EXISTS, "SNAPSHOT_EXISTS");
}

TEST_F(AdminServiceTest, ListsSnapshotsPageByPage) {
  for (const char* id : {"b", "a", "c"}) MakeSnapshot(id);
  std::vector<std::string> names;
  v1::ListSnapshotsRequest request;
  request.set_page_size(2);
  int pages = 0;
  do {
    grpc::ClientContext context;
    v1::ListSnapshotsResponse response;
    ASSERT_CALL_OK(server_.admin().ListSnapshots(&context, request, &response));
    for (const auto& s : response.snapshots()) names.push_back(s.name());
    request.set_page_token(response.next_page_token());
    ++pages;
  } while (!request.page_token().empty());
  EXPECT_THAT(names, ElementsAre("snapshots/a", "snapshots/b", "snapshots/c"));
  EXPECT_EQ(pages, 2);
}

TEST_F(AdminServiceTest, HandsOutTheBytesOfASnapshot) {
  const v1::Snapshot made = MakeSnapshot("one");
  grpc::ClientContext context;
  v1::DownloadSnapshotRequest request;
  request.set_name("snapshots/one");
  const auto reader = server_.admin().DownloadSnapshot(&context, request);
  v1::DownloadSnapshotResponse response;
  ASSERT_TRUE(reader->Read(&response));
  EXPECT_EQ(response.snapshot().sha256(), made.sha256());
  std::string bytes;
  while (reader->Read(&response)) bytes += response.chunk();
  ASSERT_CALL_OK(reader->Finish());
  EXPECT_EQ(ToHex(ComputeSha256(bytes)), made.sha256());
}

TEST_F(AdminServiceTest, RemovesASnapshot) {
  MakeSnapshot("one");
  v1::DeleteSnapshotRequest request;
  request.set_name("snapshots/one");
  v1::DeleteSnapshotResponse response;
  {
    grpc::ClientContext context;
    ASSERT_CALL_OK(
        server_.admin().DeleteSnapshot(&context, request, &response));
  }
  grpc::ClientContext context;
  EXPECT_FAILS(server_.admin().DeleteSnapshot(&context, request, &response),
               NOT_FOUND, "SNAPSHOT_NOT_FOUND");
}

TEST_F(AdminServiceTest, RefusesNamesAndIdsThatAreNone) {
  Operation operation;
  EXPECT_FAILS(StartSnapshot("../escape", &operation), INVALID_ARGUMENT,
               "NAME_INVALID");
  EXPECT_FAILS(StartSnapshot("", &operation), INVALID_ARGUMENT,
               "FIELD_REQUIRED");
  grpc::ClientContext context;
  v1::GetSnapshotRequest request;
  request.set_name("snapshots/../../catalog");
  v1::Snapshot snapshot;
  EXPECT_FAILS(server_.admin().GetSnapshot(&context, request, &snapshot),
               INVALID_ARGUMENT, "NAME_INVALID");
}

TEST_F(AdminServiceTest, VerifiesWhatIsStored) {
  Operation operation;
  {
    grpc::ClientContext context;
    ASSERT_CALL_OK(server_.admin().VerifyStorage(
        &context, v1::VerifyStorageRequest(), &operation));
  }
  operation = Wait(operation.name());
  v1::VerifyStorageResponse response;
  ASSERT_TRUE(operation.response().UnpackTo(&response));
  EXPECT_EQ(response.findings(), 0);
  EXPECT_EQ(response.shapes(), 1);
  EXPECT_EQ(response.meshes(), 1);
}

TEST_F(AdminServiceTest, KeepsOperationsUntilTheyAreDeleted) {
  Operation operation;
  ASSERT_CALL_OK(StartSnapshot("one", &operation));
  Wait(operation.name());
  google::longrunning::ListOperationsResponse list;
  {
    grpc::ClientContext context;
    ASSERT_CALL_OK(server_.operations().ListOperations(
        &context, google::longrunning::ListOperationsRequest(), &list));
  }
  ASSERT_EQ(list.operations_size(), 1);
  EXPECT_EQ(list.operations(0).name(), operation.name());
  google::longrunning::DeleteOperationRequest removal;
  removal.set_name(operation.name());
  google::protobuf::Empty nothing;
  {
    grpc::ClientContext context;
    ASSERT_CALL_OK(
        server_.operations().DeleteOperation(&context, removal, &nothing));
  }
  grpc::ClientContext context;
  google::longrunning::GetOperationRequest request;
  request.set_name(operation.name());
  EXPECT_FAILS(server_.operations().GetOperation(&context, request, &operation),
               NOT_FOUND, "OPERATION_NOT_FOUND");
}

TEST_F(AdminServiceTest, ListsOperationsPageByPage) {
  std::set<std::string> started;
  for (const char* id : {"one", "two", "three"}) {
    Operation operation;
    ASSERT_CALL_OK(StartSnapshot(id, &operation));
    started.insert(Wait(operation.name()).name());
  }
  std::set<std::string> listed;
  google::longrunning::ListOperationsRequest request;
  request.set_page_size(2);
  for (const int expected : {2, 1}) {
    grpc::ClientContext context;
    google::longrunning::ListOperationsResponse page;
    ASSERT_CALL_OK(
        server_.operations().ListOperations(&context, request, &page));
    EXPECT_EQ(page.operations_size(), expected);
    for (const Operation& operation : page.operations()) {
      listed.insert(operation.name());
    }
    request.set_page_token(page.next_page_token());
  }
  EXPECT_EQ(request.page_token(), "");
  EXPECT_EQ(listed, started);
}

TEST_F(AdminServiceTest, KnowsNoOperationThatWasNotStarted) {
  for (const auto& [name, reason] :
       std::vector<std::pair<std::string, std::string>>{
           {"operations/00000000-0000-4000-8000-000000000000",
            "OPERATION_NOT_FOUND"},
           {"operations/x", "NAME_INVALID"},
           {"", "FIELD_REQUIRED"}}) {
    grpc::ClientContext context;
    google::longrunning::WaitOperationRequest request;
    request.set_name(name);
    Operation operation;
    const ErrorOf error(
        server_.operations().WaitOperation(&context, request, &operation));
    EXPECT_EQ(error.reason, reason) << name;
    grpc::ClientContext second;
    google::longrunning::CancelOperationRequest cancel;
    cancel.set_name(name);
    google::protobuf::Empty nothing;
    EXPECT_EQ(
        ErrorOf(server_.operations().CancelOperation(&second, cancel, &nothing))
            .reason,
        reason);
  }
}

TEST_F(AdminServiceTest, EndsOperationsBeforeTheServerIsDown) {
  server_.Stop(absl::Seconds(10));
  const absl::Status large = MakeLarge(server_.folder() / "catalog.db");
  ASSERT_TRUE(large.ok()) << large;
  server_.Start();
  Operation operation;
  ASSERT_CALL_OK(StartSnapshot("one", &operation));
  const std::filesystem::path copy =
      server_.folder() / "snapshots" / "one.tar.catalog.part";
  while (!std::filesystem::exists(copy)) std::this_thread::yield();
  EXPECT_TRUE(server_.rpc().Shutdown(absl::Now() + absl::Seconds(20)));
  GaugeSheet sheet;
  server_.rpc().WriteGauges(sheet);
  EXPECT_EQ(sheet.families().at("argmesh_operations_running").samples[0].value,
            0);
  EXPECT_THAT(server_.log(), HasSubstr("CANCELLED"));
  EXPECT_TRUE(server_.engine().Close().ok());
  EXPECT_TRUE(std::filesystem::exists(server_.folder() / "clean"));
}

}  // namespace
}  // namespace argmesh
