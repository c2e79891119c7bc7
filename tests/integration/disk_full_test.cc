// A disk without space: writes that add are refused, everything else goes on,
// and writes are taken again when there is space, without a restart.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "tests/integration/server_fixture.h"

namespace argmesh {
namespace {

// Others write to the disk too: far more than they do meanwhile.
constexpr int64_t kMargin = 1LL << 30;

int64_t FreeBytes() {
  struct statvfs status {};
  if (statvfs(std::filesystem::temp_directory_path().c_str(), &status) != 0) {
    return 0;
  }
  return static_cast<int64_t>(status.f_bavail) *
         static_cast<int64_t>(status.f_frsize);
}

// Space of the disk that is taken while one lives.
class Ballast {
 public:
  explicit Ballast(const std::filesystem::path& path)
      : path_(path), file_(open(path.c_str(), O_WRONLY | O_CREAT, 0600)) {}
  ~Ballast() {
    close(file_);
    unlink(path_.c_str());
  }
  bool Take(int64_t bytes) const { return fallocate(file_, 0, 0, bytes) == 0; }

 private:
  const std::filesystem::path path_;
  const int file_;
};

TestServerOptions AlmostFull() {
  TestServerOptions options;
  options.directory.min_free_bytes = FreeBytes() - kMargin;
  return options;
}

TEST(DiskFull, RefusesWhatAddsAndServesTheRest) {
  if (FreeBytes() < 4 * kMargin) GTEST_SKIP() << "too little space to fill";
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
    const Ballast ballast(server.folder() / "ballast");
    if (!ballast.Take(2 * kMargin)) GTEST_SKIP() << "no fallocate here";
    EXPECT_FAILS(add("sphere"), RESOURCE_EXHAUSTED, "STORE_FULL");
    EXPECT_FALSE(server.engine().Store().writable);

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
