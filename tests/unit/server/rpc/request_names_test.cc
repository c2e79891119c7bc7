#include "server/rpc/request_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "argmesh/v1/collection_service.pb.h"
#include "argmesh/v1/ingest_service.pb.h"
#include "argmesh/v1/search_service.pb.h"
#include "argmesh/v1/shape_service.pb.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(RequestNames, FindsTheNamesOfARequest) {
  v1::GetShapeRequest get;
  get.set_name("collections/a/shapes/x");
  EXPECT_THAT(RequestNames(get), ElementsAre("collections/a/shapes/x"));
  v1::BatchGetShapesRequest batch;
  batch.set_parent("collections/a");
  batch.add_names("collections/b/shapes/x");
  batch.add_names("collections/c/shapes/y");
  EXPECT_THAT(RequestNames(batch),
              ElementsAre("collections/a", "collections/b/shapes/x",
                          "collections/c/shapes/y"));
}

TEST(RequestNames, LooksIntoTheMessagesOfARequest) {
  v1::CompareShapesRequest compare;
  compare.set_parent("collections/a");
  compare.mutable_query()->set_shape("collections/b/shapes/x");
  compare.mutable_target()->set_shape("collections/c/shapes/y");
  EXPECT_THAT(RequestNames(compare),
              ElementsAre("collections/a", "collections/b/shapes/x",
                          "collections/c/shapes/y"));
  v1::BatchSearchShapesRequest batch;
  batch.set_parent("collections/a");
  batch.add_requests()->set_parent("collections/b");
  batch.add_requests()->set_shape("collections/c/shapes/x");
  EXPECT_THAT(RequestNames(batch), ElementsAre("collections/a", "collections/b",
                                               "collections/c/shapes/x"));
  v1::StreamSearchShapesRequest stream;
  stream.mutable_header()->mutable_search()->set_parent("collections/a");
  EXPECT_THAT(RequestNames(stream), ElementsAre("collections/a"));
  v1::IngestShapesRequest ingest;
  ingest.mutable_hello()->set_collection("collections/a");
  EXPECT_THAT(RequestNames(ingest), ElementsAre("collections/a"));
  v1::UpdateShapeRequest update;
  update.mutable_shape()->set_name("collections/a/shapes/x");
  EXPECT_THAT(RequestNames(update), ElementsAre("collections/a/shapes/x"));
}

TEST(RequestNames, NamesACollectionThatIsToBeMade) {
  v1::CreateCollectionRequest request;
  request.set_collection_id("a");
  EXPECT_THAT(RequestNames(request), ElementsAre("collections/a"));
}

TEST(RequestNames, LeavesWhatIsNoNameAlone) {
  v1::CreateShapeRequest request;
  request.set_shape_id("x");
  request.set_source_uri("collections/b");
  (*request.mutable_metadata())["name"] = "collections/c";
  request.mutable_mesh()->set_data("collections/d");
  EXPECT_THAT(RequestNames(request), IsEmpty());
}

TEST(CollectionOfName, TakesTheSecondPart) {
  EXPECT_EQ(CollectionOfName("collections/a"), "a");
  EXPECT_EQ(CollectionOfName("collections/a/shapes/x"), "a");
  EXPECT_EQ(CollectionOfName("collections/"), "");
  EXPECT_EQ(CollectionOfName("operations/a"), "");
  EXPECT_EQ(CollectionOfName("a"), "");
  EXPECT_EQ(CollectionOfName("collections//shapes/x"), "");
}

}  // namespace
}  // namespace argmesh
