// ShapeService.BatchDeleteShapes and SearchService.BatchSearchShapes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

#include "tests/integration/server_fixture.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

class BatchTest : public ::testing::Test {
 protected:
  void SetUp() override {
    server_.Start();
    server_.MakeCollection("c");
    for (const char* id : {"a", "b"}) server_.AddShape("c", id, TorusOff());
    generation_ = server_.AddShape("c", "s", SphereOff()).generation();
  }

  static v1::BatchDeleteShapesRequest Deletion(
      const std::vector<std::string>& ids) {
    v1::BatchDeleteShapesRequest request;
    request.set_parent("collections/c");
    for (const std::string& id : ids) {
      request.add_names("collections/c/shapes/" + id);
    }
    return request;
  }

  grpc::Status Delete(const v1::BatchDeleteShapesRequest& request) {
    grpc::ClientContext context;
    return server_.shapes().BatchDeleteShapes(&context, request, &deleted_);
  }

  grpc::Status Search(const v1::BatchSearchShapesRequest& request) {
    grpc::ClientContext context;
    return server_.search().BatchSearchShapes(&context, request, &found_);
  }

  static v1::BatchSearchShapesRequest Searches(
      const std::vector<std::string>& ids) {
    v1::BatchSearchShapesRequest request;
    request.set_parent("collections/c");
    for (const std::string& id : ids) {
      request.add_requests()->set_shape("collections/c/shapes/" + id);
    }
    return request;
  }

  v1::SearchShapesResponse SearchAlone(const std::string& id) {
    v1::SearchShapesRequest request;
    request.set_parent("collections/c");
    request.set_shape("collections/c/shapes/" + id);
    grpc::ClientContext context;
    v1::SearchShapesResponse response;
    const grpc::Status status =
        server_.search().SearchShapes(&context, request, &response);
    EXPECT_TRUE(status.ok()) << ErrorOf(status);
    return response;
  }

  TestServer server_;
  int64_t generation_ = 0;
  v1::BatchDeleteShapesResponse deleted_;
  v1::BatchSearchShapesResponse found_;
};

TEST_F(BatchTest, RemovesAllShapesAndNoSearchFindsThemAfterwards) {
  ASSERT_CALL_OK(Delete(Deletion({"b", "a"})));
  EXPECT_EQ(deleted_.generation(), generation_ + 2);
  const v1::SearchShapesResponse left = SearchAlone("s");
  ASSERT_EQ(left.matches_size(), 1);
  EXPECT_EQ(left.matches(0).shape().name(), "collections/c/shapes/s");
  EXPECT_EQ(left.stats().generation(), generation_ + 2);
}

TEST_F(BatchTest, RemovesNoShapeWhenOneIsNotThere) {
  const grpc::Status status = Delete(Deletion({"a", "none", "b"}));
  EXPECT_FAILS(status, NOT_FOUND, "SHAPE_NOT_FOUND");
  EXPECT_EQ(ErrorOf(status).resource_name, "collections/c/shapes/none");
  EXPECT_EQ(SearchAlone("s").matches_size(), 3);
}

TEST_F(BatchTest, RefusesDeletionsThatAreNoBatch) {
  EXPECT_FAILS(Delete(Deletion({})), INVALID_ARGUMENT, "FIELD_REQUIRED");
  const grpc::Status twice = Delete(Deletion({"a", "b", "a"}));
  EXPECT_FAILS(twice, INVALID_ARGUMENT, "FIELD_INVALID");
  EXPECT_THAT(twice.error_message(), HasSubstr("a is named twice"));
  const grpc::Status many =
      Delete(Deletion(std::vector<std::string>(1001, "a")));
  EXPECT_FAILS(many, INVALID_ARGUMENT, "FIELD_INVALID");
  EXPECT_THAT(many.error_message(), HasSubstr("1001 names, the limit is 1000"));
  v1::BatchDeleteShapesRequest elsewhere = Deletion({"a"});
  elsewhere.add_names("collections/d/shapes/a");
  EXPECT_FAILS(Delete(elsewhere), INVALID_ARGUMENT, "FIELD_INVALID");
  EXPECT_EQ(SearchAlone("s").matches_size(), 3);
}

TEST_F(BatchTest, AnswersEverySearchAsIfItWereAlone) {
  ASSERT_CALL_OK(Search(Searches({"a", "s", "b"})));
  ASSERT_EQ(found_.responses_size(), 3);
  int i = 0;
  for (const char* id : {"a", "s", "b"}) {
    const v1::SearchShapesResponse& response = found_.responses(i++);
    const v1::SearchShapesResponse alone = SearchAlone(id);
    ASSERT_EQ(response.matches_size(), alone.matches_size());
    for (int m = 0; m < alone.matches_size(); ++m) {
      EXPECT_EQ(response.matches(m).SerializeAsString(),
                alone.matches(m).SerializeAsString());
    }
  }
}

TEST_F(BatchTest, SaysOfEachSearchWhyItFailedAndAnswersTheOthers) {
  v1::BatchSearchShapesRequest request = Searches({"a", "none", "s"});
  request.add_requests()->mutable_mesh()->set_data("no mesh");
  request.add_requests();
  ASSERT_CALL_OK(Search(request));
  ASSERT_EQ(found_.responses_size(), 5);
  EXPECT_EQ(found_.responses(0).matches_size(), 3);
  EXPECT_EQ(found_.failed_requests().size(), 3U);
  EXPECT_EQ(found_.responses(1).ByteSizeLong(), 0U);
  EXPECT_FAILS(found_.failed_requests().at(1), NOT_FOUND, "SHAPE_NOT_FOUND");
  EXPECT_EQ(found_.responses(2).matches_size(), 3);
  EXPECT_FAILS(found_.failed_requests().at(3), INVALID_ARGUMENT,
               "MESH_FORMAT_UNKNOWN");
  EXPECT_FAILS(found_.failed_requests().at(4), INVALID_ARGUMENT,
               "FIELD_REQUIRED");
}

TEST_F(BatchTest, FitsAllAnswersInOneMessageAndSaysWhatWasCut) {
  v1::BatchSearchShapesRequest request = Searches({});
  for (int i = 0; i < 100; ++i) {
    v1::SearchShapesRequest& search = *request.add_requests();
    search.set_shape("collections/c/shapes/a");
    search.set_explain(true);
    search.set_return_query_graph(true);
  }
  ASSERT_CALL_OK(Search(request));
  ASSERT_EQ(found_.responses_size(), 100);
  EXPECT_LE(found_.ByteSizeLong(), size_t{3} << 20);
  for (int i = 0; i < 100; ++i) {
    if (found_.failed_requests().contains(i)) {
      EXPECT_FAILS(found_.failed_requests().at(i), RESOURCE_EXHAUSTED,
                   "RESPONSE_TOO_LARGE");
    } else {
      EXPECT_EQ(found_.responses(i).truncated(),
                found_.responses(i).matches_size() < 3);
    }
  }
}

TEST_F(BatchTest, RefusesSearchesThatAreNoBatch) {
  EXPECT_FAILS(Search(Searches({})), INVALID_ARGUMENT, "FIELD_REQUIRED");
  const grpc::Status many =
      Search(Searches(std::vector<std::string>(101, "a")));
  EXPECT_FAILS(many, INVALID_ARGUMENT, "FIELD_INVALID");
  EXPECT_THAT(many.error_message(), HasSubstr("101 searches"));
  v1::BatchSearchShapesRequest elsewhere = Searches({"a"});
  elsewhere.mutable_requests(0)->set_parent("collections/d");
  EXPECT_FAILS(Search(elsewhere), INVALID_ARGUMENT, "FIELD_INVALID");
}

TEST_F(BatchTest, HonoursTheDeadlineOfAllSearchesTogether) {
  v1::BatchSearchShapesRequest request = Searches({});
  for (int i = 0; i < 3; ++i) {
    request.add_requests()->mutable_mesh()->set_data(SphereOff(90));
  }
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() +
                       std::chrono::milliseconds(5));
  const grpc::Status status =
      server_.search().BatchSearchShapes(&context, request, &found_);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::DEADLINE_EXCEEDED)
      << status.error_message();
  // The work stops too: nothing is left in flight soon after.
  EXPECT_TRUE(server_.Stop(absl::Seconds(5)));
}

}  // namespace
}  // namespace argmesh
