// A disk without space: writes that add are refused, everything else goes on,
// and writes are taken again when there is space, without a restart.
#include <gtest/gtest.h>

#include <string>

#include "tests/integration/server_fixture.h"
#include "tests/support/disk_ballast.h"

namespace argmesh {
namespace {

TestServerOptions AlmostFull() {
  TestServerOptions options;
  options.directory.min_free_bytes = FreeDiskBytes() - kDiskMargin;
  return options;
}

TEST(DiskFull, RefusesWhatAddsAndServesTheRest) {
  if (FreeDiskBytes() < 4 * kDiskMargin)
    GTEST_SKIP() << "too little space to fill";
  TestServer server(AlmostFull());
  server.Start();
  server.MakeCollection("parts");
  server.AddShape("parts", "torus", TorusOff());
  const auto add = [&](const std::string& id) {
    grpc::ClientContext context;
    v1::CreateShapeRequest request;
    request.set_parent("collections/parts");
    request.set_shape_id(id);
    request.mutable_mesh()->set_data(SphereOff());
    v1::Shape shape;
    return server.shapes().CreateShape(&context, request, &shape);
  };
  {
    const DiskBallast ballast(server.folder() / "ballast");
    if (!ballast.Take(2 * kDiskMargin)) GTEST_SKIP() << "no fallocate here";
    EXPECT_FAILS(add("sphere"), RESOURCE_EXHAUSTED, "STORE_FULL");
    EXPECT_FALSE(server.engine().Store().writable);

    grpc::ClientContext patch_context;
    v1::UpdateShapeRequest patch;
    patch.mutable_shape()->set_name("collections/parts/shapes/torus");
    patch.mutable_shape()->set_display_name("a ring");
    patch.mutable_update_mask()->add_paths("display_name");
    v1::Shape patched;
    EXPECT_FAILS(server.shapes().UpdateShape(&patch_context, patch, &patched),
                 RESOURCE_EXHAUSTED, "STORE_FULL");

    grpc::ClientContext search_context;
    v1::SearchShapesRequest search;
    search.set_parent("collections/parts");
    search.set_shape("collections/parts/shapes/torus");
    v1::SearchShapesResponse found;
    ASSERT_CALL_OK(
        server.search().SearchShapes(&search_context, search, &found));
    EXPECT_EQ(found.matches_size(), 1);

    grpc::ClientContext delete_context;
    v1::DeleteShapeRequest removal;
    removal.set_name("collections/parts/shapes/torus");
    v1::DeleteShapeResponse removed;
    ASSERT_CALL_OK(
        server.shapes().DeleteShape(&delete_context, removal, &removed));
  }
  ASSERT_CALL_OK(add("sphere"));
  EXPECT_TRUE(server.engine().Store().writable);
}

}  // namespace
}  // namespace argmesh
