// CollectionService.ReindexCollection: shapes of another version become ones
// of this.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <filesystem>
#include <string>

#include "tests/integration/operation_wait.h"
#include "tests/integration/server_fixture.h"

namespace argmesh {
namespace {

using google::longrunning::Operation;

class ReindexTest : public ::testing::Test {
 protected:
  void SetUp() override {
    server_.Start();
    server_.MakeCollection("c");
    server_.AddShape("c", "a", TorusOff(), {{"class", "ring"}});
    server_.AddShape("c", "b", SphereOff());
    server_.AddShape("c", "d", DumbbellOff());
  }

  // As if a server of another version had written it.
  void Outdate(const std::string& where) {
    ASSERT_TRUE(server_.Stop(absl::Seconds(10)));
    sqlite3* db = nullptr;
    ASSERT_EQ(sqlite3_open((server_.folder() / "catalog.db").c_str(), &db),
              SQLITE_OK);
    const std::string sql =
        "UPDATE graph SET algorithm_version = algorithm_version - 1 " + where +
        "; UPDATE collection SET graph_version = graph_version - 1;";
    EXPECT_EQ(sqlite3_exec(db, sql.c_str(), nullptr, nullptr, nullptr),
              SQLITE_OK)
        << sqlite3_errmsg(db);
    sqlite3_close(db);
    server_.Start();
  }

  grpc::Status Reindex(const std::string& collection, Operation* operation,
                       const v1::CollectionSettings* settings = nullptr) {
    grpc::ClientContext context;
    v1::ReindexCollectionRequest request;
    request.set_name("collections/" + collection);
    if (settings != nullptr) *request.mutable_settings() = *settings;
    return server_.collections().ReindexCollection(&context, request,
                                                   operation);
  }

  v1::ReindexCollectionResponse ReindexToTheEnd(
      const v1::CollectionSettings* settings = nullptr) {
    Operation operation;
    const grpc::Status status = Reindex("c", &operation, settings);
    EXPECT_TRUE(status.ok()) << ErrorOf(status);
    done_ = WaitForOperation(server_, operation.name());
    return ResponseOf<v1::ReindexCollectionResponse>(done_);
  }

  v1::Collection GetCollection(const std::string& id) {
    grpc::ClientContext context;
    v1::GetCollectionRequest request;
    request.set_name("collections/" + id);
    v1::Collection collection;
    EXPECT_TRUE(server_.collections()
                    .GetCollection(&context, request, &collection)
                    .ok());
    return collection;
  }

  v1::SearchShapesResponse Search(const std::string& collection = "c") {
    grpc::ClientContext context;
    v1::SearchShapesRequest request;
    request.set_parent("collections/" + collection);
    request.mutable_mesh()->set_data(TorusOff());
    v1::SearchShapesResponse response;
    const grpc::Status status =
        server_.search().SearchShapes(&context, request, &response);
    EXPECT_TRUE(status.ok()) << ErrorOf(status);
    return response;
  }

  // Removes the file of a shape's mesh, which all others do without.
  void LoseMesh(const std::string& id) {
    const std::string sha256 = Get(id).mesh().sha256();
    int removed = 0;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(server_.folder())) {
      if (entry.path().string().ends_with(sha256)) {
        removed += std::filesystem::remove(entry.path()) ? 1 : 0;
      }
    }
    ASSERT_EQ(removed, 1);
  }

  v1::Shape Get(const std::string& id, const std::string& collection = "c") {
    grpc::ClientContext context;
    v1::GetShapeRequest request;
    request.set_name("collections/" + collection + "/shapes/" + id);
    v1::Shape shape;
    EXPECT_TRUE(server_.shapes().GetShape(&context, request, &shape).ok());
    return shape;
  }

  TestServer server_;
  Operation done_;
};

TEST_F(ReindexTest, MakesOutdatedShapesSearchableAsTheyWereBefore) {
  const v1::SearchShapesResponse before = Search();
  const v1::Shape shape = Get("a");
  Outdate("");
  EXPECT_EQ(Search().stats().shapes_unusable(), 3);
  const v1::ReindexCollectionResponse response = ReindexToTheEnd();
  EXPECT_EQ(response.reindexed(), 3);
  EXPECT_EQ(response.failed(), 0);
  const v1::OperationMetadata metadata = MetadataOf(done_);
  EXPECT_EQ(metadata.method(), "CollectionService.ReindexCollection");
  EXPECT_EQ(metadata.resource(), "collections/c");
  EXPECT_EQ(metadata.items(), 3);
  EXPECT_EQ(metadata.items_done(), 3);
  EXPECT_EQ(metadata.items_failed(), 0);
  const v1::SearchShapesResponse after = Search();
  EXPECT_EQ(after.stats().shapes_unusable(), 0);
  ASSERT_EQ(after.matches_size(), before.matches_size());
  for (int i = 0; i < after.matches_size(); ++i) {
    EXPECT_EQ(after.matches(i).shape().name(),
              before.matches(i).shape().name());
    EXPECT_EQ(after.matches(i).score(), before.matches(i).score());
  }
  const v1::Shape again = Get("a");
  EXPECT_EQ(again.metadata().at("class"), "ring");
  EXPECT_EQ(again.mesh().sha256(), shape.mesh().sha256());
  EXPECT_TRUE(again.mesh().stored());
  EXPECT_EQ(again.create_time().seconds(), shape.create_time().seconds());
  EXPECT_EQ(again.graph().SerializeAsString(),
            shape.graph().SerializeAsString());
}

TEST_F(ReindexTest, LeavesShapesThatAreUpToDateAsTheyAre) {
  const std::string etag = Get("a").etag();
  Outdate("WHERE shape_id = (SELECT id FROM shape WHERE name = 'b')");
  EXPECT_EQ(ReindexToTheEnd().reindexed(), 1);
  EXPECT_EQ(Get("a").etag(), etag);
  EXPECT_EQ(ReindexToTheEnd().reindexed(), 0);
  EXPECT_EQ(MetadataOf(done_).items(), 0);
}

TEST_F(ReindexTest, LetsTheCollectionTakeShapesAgain) {
  Outdate("");
  grpc::ClientContext context;
  v1::CreateShapeRequest request;
  request.set_parent("collections/c");
  request.set_shape_id("new");
  request.mutable_mesh()->set_data(TorusOff(0.3));
  v1::Shape shape;
  EXPECT_FAILS(server_.shapes().CreateShape(&context, request, &shape),
               FAILED_PRECONDITION, "GRAPH_VERSION_MISMATCH");
  ReindexToTheEnd();
  grpc::ClientContext second;
  ASSERT_CALL_OK(server_.shapes().CreateShape(&second, request, &shape));
}

TEST_F(ReindexTest, NamesTheShapeThatFailedAndDoesTheOthers) {
  ASSERT_NO_FATAL_FAILURE(LoseMesh("b"));
  Outdate("");
  const v1::ReindexCollectionResponse response = ReindexToTheEnd();
  EXPECT_EQ(response.reindexed(), 2);
  EXPECT_EQ(response.failed(), 1);
  ASSERT_EQ(response.failures_size(), 1);
  EXPECT_EQ(response.failures(0).shape(), "collections/c/shapes/b");
  EXPECT_FAILS(response.failures(0).error(), DATA_LOSS, "STORED_DATA_DAMAGED");
  EXPECT_EQ(MetadataOf(done_).items_failed(), 1);
  EXPECT_EQ(Search().stats().shapes_unusable(), 1);
}

TEST_F(ReindexTest, GoesOnWhereItWasCancelled) {
  for (int i = 0; i < 6; ++i) {
    server_.AddShape("c", "s" + std::to_string(i), SphereOff(60 + i));
  }
  Outdate("");
  Operation operation;
  ASSERT_CALL_OK(Reindex("c", &operation));
  CancelOperation(server_, operation.name());
  operation = WaitForOperation(server_, operation.name());
  EXPECT_FAILS(operation.error(), CANCELLED, "CANCELLED");
  const int64_t done = MetadataOf(operation).items_done();
  EXPECT_LT(done, 9);
  server_.Restart();
  EXPECT_EQ(ReindexToTheEnd().reindexed(), 9 - done);
  EXPECT_EQ(Search().stats().shapes_unusable(), 0);
}

TEST_F(ReindexTest, RefusesWhatItCannotDo) {
  server_.MakeCollection("graphs-only", /*store_meshes=*/false);
  Operation operation;
  EXPECT_FAILS(Reindex("graphs-only", &operation), FAILED_PRECONDITION,
               "MESH_NOT_STORED");
  EXPECT_FAILS(Reindex("none", &operation), NOT_FOUND, "COLLECTION_NOT_FOUND");
  v1::CollectionSettings settings;
  settings.set_vertex_budget(99);
  const grpc::Status range = Reindex("c", &operation, &settings);
  EXPECT_FAILS(range, INVALID_ARGUMENT, "FIELD_INVALID");
  EXPECT_EQ(ErrorOf(range).bad_field, "settings.vertex_budget");
  settings.set_vertex_budget(500);
  settings.set_store_meshes(false);
  const grpc::Status meshes = Reindex("c", &operation, &settings);
  EXPECT_FAILS(meshes, INVALID_ARGUMENT, "FIELD_INVALID");
  EXPECT_EQ(ErrorOf(meshes).bad_field, "settings.store_meshes");
  settings.clear_store_meshes();
  settings.set_decomposition(v1::DECOMPOSITION_KIND_GIVEN);
  const grpc::Status given = Reindex("c", &operation, &settings);
  EXPECT_FAILS(given, INVALID_ARGUMENT, "FIELD_INVALID");
  EXPECT_EQ(ErrorOf(given).bad_field, "settings.decomposition");
}

TEST_F(ReindexTest, GivesTheCollectionOtherSettingsAndKeepsThoseNotNamed) {
  const v1::Collection before = GetCollection("c");
  const v1::Shape shape = Get("a");
  v1::CollectionSettings settings;
  settings.set_decomposition(v1::DECOMPOSITION_KIND_VORONOI);
  settings.set_uniform_cells(7);
  const v1::ReindexCollectionResponse response = ReindexToTheEnd(&settings);
  EXPECT_EQ(response.reindexed(), 3);
  EXPECT_EQ(response.failed(), 0);
  EXPECT_EQ(MetadataOf(done_).items(), 3);
  EXPECT_EQ(MetadataOf(done_).items_done(), 3);
  const v1::Collection after = GetCollection("c");
  EXPECT_EQ(response.collection().SerializeAsString(),
            after.SerializeAsString());
  EXPECT_EQ(after.settings().decomposition(), v1::DECOMPOSITION_KIND_VORONOI);
  EXPECT_EQ(after.settings().uniform_cells(), 7);
  EXPECT_EQ(after.settings().vertex_budget(),
            before.settings().vertex_budget());
  EXPECT_TRUE(after.settings().store_meshes());
  EXPECT_EQ(after.generation(), before.generation() + 1);
  EXPECT_NE(after.etag(), before.etag());
  const v1::Shape again = Get("a");
  EXPECT_EQ(again.uid(), shape.uid());
  EXPECT_EQ(again.generation(), after.generation());
  EXPECT_NE(again.etag(), shape.etag());
  EXPECT_EQ(again.metadata().at("class"), "ring");
  EXPECT_EQ(again.create_time().seconds(), shape.create_time().seconds());
}

TEST_F(ReindexTest, FindsWhatAFreshCollectionOfTheseSettingsFinds) {
  v1::CollectionSettings settings;
  settings.set_vertex_budget(260);
  ReindexToTheEnd(&settings);
  grpc::ClientContext context;
  v1::CreateCollectionRequest request;
  request.set_collection_id("fresh");
  *request.mutable_collection()->mutable_settings() =
      GetCollection("c").settings();
  v1::Collection fresh;
  ASSERT_CALL_OK(
      server_.collections().CreateCollection(&context, request, &fresh));
  server_.AddShape("fresh", "a", TorusOff(), {{"class", "ring"}});
  server_.AddShape("fresh", "b", SphereOff());
  server_.AddShape("fresh", "d", DumbbellOff());
  for (const bool restarted : {false, true}) {
    if (restarted) server_.Restart();
    const v1::SearchShapesResponse expected = Search("fresh");
    const v1::SearchShapesResponse found = Search();
    EXPECT_EQ(found.stats().shapes_unusable(), 0);
    ASSERT_EQ(found.matches_size(), 3);
    for (int i = 0; i < 3; ++i) {
      EXPECT_TRUE(found.matches(i).shape().name().ends_with(
          expected.matches(i).shape().name().substr(
              std::string("collections/fresh").size())));
      EXPECT_EQ(found.matches(i).score(), expected.matches(i).score());
    }
    for (const char* id : {"a", "b", "d"}) {
      EXPECT_EQ(Get(id).graph().SerializeAsString(),
                Get(id, "fresh").graph().SerializeAsString());
    }
  }
}

TEST_F(ReindexTest, KeepsTheOldSettingsWhenAShapeFailsAndNamesIt) {
  const v1::Collection before = GetCollection("c");
  ASSERT_NO_FATAL_FAILURE(LoseMesh("b"));
  v1::CollectionSettings settings;
  settings.set_vertex_budget(260);
  const v1::ReindexCollectionResponse response = ReindexToTheEnd(&settings);
  EXPECT_EQ(response.reindexed(), 2);
  ASSERT_EQ(response.failures_size(), 1);
  EXPECT_EQ(response.failures(0).shape(), "collections/c/shapes/b");
  EXPECT_FAILS(response.failures(0).error(), DATA_LOSS, "STORED_DATA_DAMAGED");
  EXPECT_EQ(GetCollection("c").SerializeAsString(), before.SerializeAsString());
  EXPECT_EQ(Search().matches_size(), 3);
}

TEST_F(ReindexTest, GoesOnWithOtherSettingsAfterACancellationAndARestart) {
  for (int i = 0; i < 6; ++i) {
    server_.AddShape("c", "s" + std::to_string(i), SphereOff(60 + i));
  }
  v1::CollectionSettings settings;
  settings.set_vertex_budget(260);
  Operation operation;
  ASSERT_CALL_OK(Reindex("c", &operation, &settings));
  CancelOperation(server_, operation.name());
  operation = WaitForOperation(server_, operation.name());
  EXPECT_FAILS(operation.error(), CANCELLED, "CANCELLED");
  EXPECT_EQ(GetCollection("c").settings().vertex_budget(), 300);
  const int64_t done = MetadataOf(operation).items_done();
  server_.Restart();
  EXPECT_EQ(Search().stats().shapes_unusable(), 0);
  EXPECT_EQ(ReindexToTheEnd(&settings).reindexed(), 9 - done);
  EXPECT_EQ(GetCollection("c").settings().vertex_budget(), 260);
}

TEST_F(ReindexTest, DescribesOutdatedShapesBeforeItSwitches) {
  Outdate("");
  v1::CollectionSettings settings;
  settings.set_vertex_budget(260);
  const v1::ReindexCollectionResponse response = ReindexToTheEnd(&settings);
  EXPECT_EQ(response.reindexed(), 6);
  EXPECT_EQ(MetadataOf(done_).items(), 6);
  EXPECT_EQ(response.collection().settings().vertex_budget(), 260);
  EXPECT_EQ(Search().stats().shapes_unusable(), 0);
}

}  // namespace
}  // namespace argmesh
