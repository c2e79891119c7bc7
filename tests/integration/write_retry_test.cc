// A write that is asked for again with its request_id answers as the first
// time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/integration/server_fixture.h"

namespace argmesh {
namespace {

constexpr char kOneId[] = "11111111-2222-4333-8444-555555555555";
constexpr char kAnotherId[] = "66666666-7777-4888-9999-aaaaaaaaaaaa";

class WriteRetryTest : public ::testing::Test {
 protected:
  void SetUp() override {
    server_.Start();
    server_.MakeCollection("c");
    stored_ = server_.AddShape("c", "s", SphereOff());
  }

  grpc::Status Update(const v1::UpdateShapeRequest& request, v1::Shape* shape) {
    grpc::ClientContext context;
    return server_.shapes().UpdateShape(&context, request, shape);
  }

  TestServer server_;
  v1::Shape stored_;
};

TEST_F(WriteRetryTest, OfAShapeKeepsToTheFirstUpdate) {
  v1::UpdateShapeRequest request;
  request.set_request_id(kOneId);
  request.mutable_shape()->set_name(stored_.name());
  request.mutable_shape()->set_etag(stored_.etag());
  request.mutable_shape()->set_display_name("ball");
  v1::Shape first;
  v1::Shape second;
  ASSERT_CALL_OK(Update(request, &first));
  ASSERT_CALL_OK(Update(request, &second));
  EXPECT_EQ(second.SerializeAsString(), first.SerializeAsString());

  request.mutable_shape()->set_display_name("sphere");
  EXPECT_FAILS(Update(request, &second), INVALID_ARGUMENT, "REQUEST_ID_REUSED");
  request.set_request_id(kAnotherId);
  EXPECT_FAILS(Update(request, &second), ABORTED, "ETAG_MISMATCH");
  request.set_request_id("no uuid");
  EXPECT_FAILS(Update(request, &second), INVALID_ARGUMENT, "FIELD_INVALID");
}

TEST_F(WriteRetryTest, OfACollectionKeepsToTheFirstUpdateAndDeletion) {
  v1::UpdateCollectionRequest update;
  update.set_request_id(kOneId);
  update.mutable_collection()->set_name("collections/c");
  update.mutable_collection()->set_display_name("all of them");
  v1::Collection first;
  v1::Collection second;
  for (v1::Collection* answer : {&first, &second}) {
    grpc::ClientContext context;
    ASSERT_CALL_OK(
        server_.collections().UpdateCollection(&context, update, answer));
  }
  EXPECT_EQ(second.etag(), first.etag());

  v1::DeleteCollectionRequest removal;
  removal.set_name("collections/c");
  removal.set_force(true);
  removal.set_request_id(kAnotherId);
  for (int time = 0; time < 2; ++time) {
    grpc::ClientContext context;
    v1::DeleteCollectionResponse answer;
    ASSERT_CALL_OK(
        server_.collections().DeleteCollection(&context, removal, &answer));
  }
}

TEST_F(WriteRetryTest, OfADeletionOfManyAnswersTheSameGeneration) {
  v1::BatchDeleteShapesRequest request;
  request.set_parent("collections/c");
  request.add_names(stored_.name());
  request.set_request_id(kOneId);
  v1::BatchDeleteShapesResponse first;
  v1::BatchDeleteShapesResponse second;
  for (v1::BatchDeleteShapesResponse* answer : {&first, &second}) {
    grpc::ClientContext context;
    ASSERT_CALL_OK(
        server_.shapes().BatchDeleteShapes(&context, request, answer));
  }
  EXPECT_EQ(first.generation(), stored_.generation() + 1);
  EXPECT_EQ(second.generation(), first.generation());
}

}  // namespace
}  // namespace argmesh
