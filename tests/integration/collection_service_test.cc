#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/integration/server_fixture.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;

class CollectionServiceTest : public ::testing::Test {
 protected:
  void SetUp() override { server_.Start(); }

  grpc::Status Create(const v1::CreateCollectionRequest& request,
                      v1::Collection* response) {
    grpc::ClientContext context;
    return server_.collections().CreateCollection(&context, request, response);
  }

  grpc::Status Create(const std::string& id) {
    v1::CreateCollectionRequest request;
    request.set_collection_id(id);
    v1::Collection response;
    return Create(request, &response);
  }

  grpc::Status Get(const std::string& name, v1::Collection* response) {
    grpc::ClientContext context;
    v1::GetCollectionRequest request;
    request.set_name(name);
    return server_.collections().GetCollection(&context, request, response);
  }

  grpc::Status Delete(const std::string& name, bool force,
                      const std::string& etag = "") {
    grpc::ClientContext context;
    v1::DeleteCollectionRequest request;
    request.set_name(name);
    request.set_force(force);
    request.set_etag(etag);
    v1::DeleteCollectionResponse response;
    return server_.collections().DeleteCollection(&context, request, &response);
  }

  TestServer server_;
};

TEST_F(CollectionServiceTest, AnswersWhatWasCreatedWithDefaultsFilledIn) {
  v1::CreateCollectionRequest request;
  request.set_collection_id("cups");
  request.mutable_collection()->set_display_name("Cups & mugs");
  request.mutable_collection()->mutable_settings()->set_uniform_cells(0);
  v1::Collection created;
  ASSERT_CALL_OK(Create(request, &created));
  EXPECT_EQ(created.name(), "collections/cups");
  EXPECT_EQ(created.display_name(), "Cups & mugs");
  EXPECT_FALSE(created.uid().empty());
  EXPECT_FALSE(created.etag().empty());
  EXPECT_EQ(created.settings().decomposition(),
            v1::DECOMPOSITION_KIND_BIHARMONIC);
  EXPECT_EQ(created.settings().vertex_budget(), 3000);
  EXPECT_EQ(created.settings().uniform_cells(), 0);
  EXPECT_TRUE(created.settings().store_meshes());
  EXPECT_GT(created.create_time().seconds(), 1'600'000'000);
  EXPECT_GT(created.graph_version(), 0u);

  v1::Collection stored;
  ASSERT_CALL_OK(Get("collections/cups", &stored));
  EXPECT_EQ(stored.SerializeAsString(), created.SerializeAsString());
}

TEST_F(CollectionServiceTest, SurvivesARestart) {
  server_.MakeCollection("kept");
  v1::Collection before;
  ASSERT_CALL_OK(Get("collections/kept", &before));
  server_.Restart();
  v1::Collection after;
  ASSERT_CALL_OK(Get("collections/kept", &after));
  EXPECT_EQ(before.SerializeAsString(), after.SerializeAsString());
}

TEST_F(CollectionServiceTest, RefusesATakenId) {
  ASSERT_CALL_OK(Create("twice"));
  const grpc::Status again = Create("twice");
  EXPECT_FAILS(again, ALREADY_EXISTS, "COLLECTION_EXISTS");
  const ErrorOf error(again);
  EXPECT_EQ(error.domain, "argmesh.v1");
  EXPECT_EQ(error.resource_name, "collections/twice");
}

TEST_F(CollectionServiceTest, RefusesIdsAndSettingsThatAreNone) {
  EXPECT_FAILS(Create(""), INVALID_ARGUMENT, "FIELD_REQUIRED");
  EXPECT_FAILS(Create("Upper"), INVALID_ARGUMENT, "NAME_INVALID");
  EXPECT_FAILS(Create("a/b"), INVALID_ARGUMENT, "NAME_INVALID");
  EXPECT_FAILS(Create(std::string(64, 'a')), INVALID_ARGUMENT, "NAME_INVALID");
  EXPECT_EQ(ErrorOf(Create("Upper")).bad_field, "collection_id");

  v1::CreateCollectionRequest request;
  request.set_collection_id("ok");
  auto& settings = *request.mutable_collection()->mutable_settings();
  v1::Collection response;
  settings.set_vertex_budget(99);
  EXPECT_FAILS(Create(request, &response), INVALID_ARGUMENT, "FIELD_INVALID");
  settings.set_vertex_budget(0);
  settings.set_uniform_cells(-1);
  EXPECT_FAILS(Create(request, &response), INVALID_ARGUMENT, "FIELD_INVALID");
  settings.clear_uniform_cells();
  settings.set_decomposition(v1::DECOMPOSITION_KIND_GIVEN);
  EXPECT_FAILS(Create(request, &response), INVALID_ARGUMENT, "FIELD_INVALID");
  settings.set_decomposition(static_cast<v1::DecompositionKind>(77));
  EXPECT_FAILS(Create(request, &response), INVALID_ARGUMENT, "FIELD_INVALID");
}

TEST_F(CollectionServiceTest, AnswersARetriedCreateWithTheFirstAnswer) {
  v1::CreateCollectionRequest request;
  request.set_collection_id("once");
  request.set_request_id("7b0a6f5e-9a61-4c0e-8d5c-0b8d7b1a2c3d");
  v1::Collection first;
  v1::Collection second;
  ASSERT_CALL_OK(Create(request, &first));
  ASSERT_CALL_OK(Create(request, &second));
  EXPECT_EQ(first.uid(), second.uid());
  request.set_collection_id("other");
  EXPECT_FAILS(Create(request, &second), INVALID_ARGUMENT, "REQUEST_ID_REUSED");
}

TEST_F(CollectionServiceTest, SaysWhatIsNotThere) {
  v1::Collection response;
  const grpc::Status missing = Get("collections/none", &response);
  EXPECT_FAILS(missing, NOT_FOUND, "COLLECTION_NOT_FOUND");
  EXPECT_EQ(ErrorOf(missing).resource_name, "collections/none");
  EXPECT_FAILS(Get("", &response), INVALID_ARGUMENT, "FIELD_REQUIRED");
  EXPECT_FAILS(Get("none", &response), INVALID_ARGUMENT, "NAME_INVALID");
  EXPECT_FAILS(Get("collections/a/shapes/b", &response), INVALID_ARGUMENT,
               "NAME_INVALID");
  EXPECT_FAILS(Delete("collections/none", true), NOT_FOUND,
               "COLLECTION_NOT_FOUND");
}

TEST_F(CollectionServiceTest, ListsEveryCollectionOnceInOrderOfName) {
  const std::vector<std::string> ids = {"e", "b", "d", "a", "c"};
  for (const std::string& id : ids) ASSERT_CALL_OK(Create(id));
  std::vector<std::string> listed;
  v1::ListCollectionsRequest request;
  request.set_page_size(2);
  int pages = 0;
  do {
    grpc::ClientContext context;
    v1::ListCollectionsResponse response;
    ASSERT_CALL_OK(
        server_.collections().ListCollections(&context, request, &response));
    EXPECT_LE(response.collections_size(), 2);
    for (const auto& collection : response.collections()) {
      listed.push_back(collection.name());
    }
    request.set_page_token(response.next_page_token());
    ++pages;
  } while (!request.page_token().empty() && pages < 10);
  EXPECT_THAT(listed,
              ElementsAre("collections/a", "collections/b", "collections/c",
                          "collections/d", "collections/e"));
  EXPECT_EQ(pages, 3);
}

TEST_F(CollectionServiceTest, RefusesPageTokensItDidNotMake) {
  grpc::ClientContext first;
  v1::ListCollectionsRequest request;
  v1::ListCollectionsResponse response;
  request.set_page_token("made up");
  EXPECT_FAILS(
      server_.collections().ListCollections(&first, request, &response),
      INVALID_ARGUMENT, "PAGE_TOKEN_INVALID");
  grpc::ClientContext second;
  request.clear_page_token();
  request.set_page_size(-1);
  EXPECT_FAILS(
      server_.collections().ListCollections(&second, request, &response),
      INVALID_ARGUMENT, "FIELD_INVALID");
}

TEST_F(CollectionServiceTest, DeletesACollectionWithShapesOnlyByForce) {
  server_.MakeCollection("full");
  server_.AddShape("full", "torus", TorusOff());
  EXPECT_FAILS(Delete("collections/full", false), FAILED_PRECONDITION,
               "COLLECTION_NOT_EMPTY");
  EXPECT_FAILS(Delete("collections/full", true, "\"not the etag\""), ABORTED,
               "ETAG_MISMATCH");
  ASSERT_CALL_OK(Delete("collections/full", true));
  v1::Collection response;
  EXPECT_FAILS(Get("collections/full", &response), NOT_FOUND,
               "COLLECTION_NOT_FOUND");
}

}  // namespace
}  // namespace argmesh
