// UpdateCollection, UpdateShape and BatchGetShapes.
#include <gtest/gtest.h>

#include <string>

#include "tests/integration/server_fixture.h"

namespace argmesh {
namespace {

class UpdateTest : public ::testing::Test {
 protected:
  UpdateTest() {
    server_.Start();
    server_.MakeCollection("parts");
    shape_ = server_.AddShape("parts", "torus", TorusOff());
  }

  grpc::Status Update(const v1::Shape& shape,
                      const std::vector<std::string>& mask,
                      v1::Shape* response) {
    grpc::ClientContext context;
    v1::UpdateShapeRequest request;
    *request.mutable_shape() = shape;
    for (const std::string& path : mask) {
      request.mutable_update_mask()->add_paths(path);
    }
    return server_.shapes().UpdateShape(&context, request, response);
  }

  v1::Shape Change() const {
    v1::Shape shape;
    shape.set_name(shape_.name());
    shape.set_display_name("The torus");
    shape.set_source_uri("file:///torus.off");
    (*shape.mutable_metadata())["colour"] = "red";
    return shape;
  }

  TestServer server_;
  v1::Shape shape_;
};

TEST_F(UpdateTest, ChangesWhatTheMaskNames) {
  v1::Shape updated;
  ASSERT_CALL_OK(Update(Change(), {"display_name"}, &updated));
  EXPECT_EQ(updated.display_name(), "The torus");
  EXPECT_EQ(updated.source_uri(), "");
  EXPECT_EQ(updated.metadata_size(), 0);
  EXPECT_EQ(updated.mesh().sha256(), shape_.mesh().sha256());
  EXPECT_GT(updated.generation(), shape_.generation());
  EXPECT_NE(updated.etag(), shape_.etag());
}

TEST_F(UpdateTest, ChangesWhatIsSetWithoutAMask) {
  v1::Shape change = Change();
  change.clear_source_uri();
  v1::Shape updated;
  ASSERT_CALL_OK(Update(change, {}, &updated));
  EXPECT_EQ(updated.display_name(), "The torus");
  EXPECT_EQ(updated.metadata().at("colour"), "red");
}

TEST_F(UpdateTest, ClearsWithAStar) {
  v1::Shape updated;
  ASSERT_CALL_OK(Update(Change(), {"*"}, &updated));
  EXPECT_EQ(updated.source_uri(), "file:///torus.off");
  v1::Shape empty;
  empty.set_name(shape_.name());
  ASSERT_CALL_OK(Update(empty, {"*"}, &updated));
  EXPECT_EQ(updated.display_name(), "");
  EXPECT_EQ(updated.source_uri(), "");
  EXPECT_EQ(updated.metadata_size(), 0);
}

TEST_F(UpdateTest, GuardsByEtag) {
  v1::Shape change = Change();
  change.set_etag(shape_.etag());
  v1::Shape updated;
  ASSERT_CALL_OK(Update(change, {}, &updated));
  EXPECT_FAILS(Update(change, {}, &updated), ABORTED, "ETAG_MISMATCH");
}

TEST_F(UpdateTest, RefusesFieldsThatMayNotChange) {
  v1::Shape updated;
  for (const char* path : {"name", "sha256", "metadata.colour", "", "Name"}) {
    EXPECT_FAILS(Update(Change(), {path}, &updated), INVALID_ARGUMENT,
                 "FIELD_INVALID");
  }
  v1::Shape nothing;
  nothing.set_name(shape_.name());
  EXPECT_FAILS(Update(nothing, {}, &updated), INVALID_ARGUMENT,
               "FIELD_INVALID");
  EXPECT_FAILS(Update(v1::Shape(), {"*"}, &updated), INVALID_ARGUMENT,
               "FIELD_REQUIRED");
  nothing.set_name("collections/parts/shapes/none");
  EXPECT_FAILS(Update(nothing, {"*"}, &updated), NOT_FOUND, "SHAPE_NOT_FOUND");
}

TEST_F(UpdateTest, RenamesACollection) {
  v1::UpdateCollectionRequest request;
  request.mutable_collection()->set_name("collections/parts");
  request.mutable_collection()->set_display_name("All the parts");
  v1::Collection collection;
  {
    grpc::ClientContext context;
    ASSERT_CALL_OK(
        server_.collections().UpdateCollection(&context, request, &collection));
  }
  EXPECT_EQ(collection.display_name(), "All the parts");
  request.mutable_collection()->set_etag("\"another\"");
  {
    grpc::ClientContext context;
    EXPECT_FAILS(
        server_.collections().UpdateCollection(&context, request, &collection),
        ABORTED, "ETAG_MISMATCH");
  }
  request.mutable_update_mask()->add_paths("settings");
  grpc::ClientContext context;
  EXPECT_FAILS(
      server_.collections().UpdateCollection(&context, request, &collection),
      INVALID_ARGUMENT, "FIELD_INVALID");
}

TEST_F(UpdateTest, DeclaresMetadataKeysThatTheShapesKeepTo) {
  v1::Shape updated;
  ASSERT_CALL_OK(Update(Change(), {"metadata"}, &updated));
  v1::UpdateCollectionRequest request;
  request.mutable_collection()->set_name("collections/parts");
  v1::MetadataKey& key = *request.mutable_collection()->add_metadata_keys();
  key.set_key("colour");
  v1::Collection collection;
  const auto declare = [&](v1::MetadataType type) {
    key.set_type(type);
    grpc::ClientContext context;
    return server_.collections().UpdateCollection(&context, request,
                                                  &collection);
  };
  EXPECT_FAILS(declare(v1::METADATA_TYPE_UNSPECIFIED), INVALID_ARGUMENT,
               "FIELD_INVALID");
  EXPECT_FAILS(declare(v1::METADATA_TYPE_NUMBER), INVALID_ARGUMENT,
               "FIELD_INVALID");
  ASSERT_CALL_OK(declare(v1::METADATA_TYPE_STRING));
  ASSERT_EQ(collection.metadata_keys_size(), 1);
  EXPECT_EQ(collection.metadata_keys(0).key(), "colour");
  EXPECT_EQ(collection.metadata_keys(0).type(), v1::METADATA_TYPE_STRING);
}

TEST_F(UpdateTest, GetsManyShapesInTheOrderOfTheirNames) {
  server_.AddShape("parts", "sphere", SphereOff());
  v1::BatchGetShapesRequest request;
  request.set_parent("collections/parts");
  for (const char* id : {"torus", "sphere", "torus"}) {
    request.add_names(std::string("collections/parts/shapes/") + id);
  }
  v1::BatchGetShapesResponse response;
  const auto get = [&] {
    grpc::ClientContext context;
    return server_.shapes().BatchGetShapes(&context, request, &response);
  };
  ASSERT_CALL_OK(get());
  ASSERT_EQ(response.shapes_size(), 3);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(response.shapes(i).name(), request.names(i));
  }
  request.add_names("collections/parts/shapes/none");
  EXPECT_FAILS(get(), NOT_FOUND, "SHAPE_NOT_FOUND");
  request.set_names(3, "collections/others/shapes/torus");
  EXPECT_FAILS(get(), INVALID_ARGUMENT, "FIELD_INVALID");
  request.clear_names();
  EXPECT_FAILS(get(), INVALID_ARGUMENT, "FIELD_REQUIRED");
  for (int i = 0; i <= 1000; ++i) {
    request.add_names("collections/parts/shapes/torus");
  }
  EXPECT_FAILS(get(), INVALID_ARGUMENT, "FIELD_INVALID");
}

}  // namespace
}  // namespace argmesh
