#include "server/engine/housekeeping.h"

#include <atomic>

#include "absl/synchronization/notification.h"
#include "absl/time/clock.h"
#include "server/storage/sqlite_catalog.h"
#include "tests/support/catalog_samples.h"
#include "tests/support/temporary_directory.h"
#include "tests/unit/server/engine/engine_bench.h"

namespace argmesh {
namespace {

// Until it holds, 30 s at most.
template <typename Condition>
bool Comes(const Condition& condition) {
  const absl::Time end = absl::Now() + absl::Seconds(30);
  while (!condition() && absl::Now() < end) {
    absl::SleepFor(absl::Milliseconds(10));
  }
  return condition();
}

// Gives the mesh of a deleted collection up later, and fails before that.
class LeavingCatalog : public MemoryCatalog {
 public:
  LeavingCatalog(const Sha256Digest& mesh, const absl::Notification& later)
      : mesh_(mesh), later_(later) {}

  absl::StatusOr<CollectionDeleted> DeleteCollection(
      const CollectionDelete& removal) override {
    ARGMESH_ASSIGN_OR_RETURN(CollectionDeleted deleted,
                             MemoryCatalog::DeleteCollection(removal));
    deleted.unreferenced.clear();
    left_ = 3;
    return deleted;
  }
  absl::StatusOr<RemovedShapes> RemoveSomeDeleted() override {
    if (left_ == 0) return RemovedShapes{};
    later_.WaitForNotification();
    if (!failed_.exchange(true)) return absl::UnavailableError("disk full");
    --left_;
    return RemovedShapes{true, {mesh_}};
  }
  int left() const { return left_; }

 private:
  const Sha256Digest mesh_;
  const absl::Notification& later_;
  std::atomic<int> left_{0};
  std::atomic<bool> failed_{false};
};

TEST(HousekeepingTest, RemovesWhatADeletedCollectionLeftUntilNothingIs) {
  const std::string mesh = TorusOff(3);
  absl::Notification later;
  auto catalog = std::make_unique<LeavingCatalog>(ComputeSha256(mesh), later);
  auto meshes = std::make_unique<MemoryMeshStore>();
  const LeavingCatalog& leaving = *catalog;
  const MemoryMeshStore& stored = *meshes;
  ASSERT_OK_AND_ASSIGN(
      const std::unique_ptr<Engine> engine,
      Engine::Create({}, std::move(catalog), std::move(meshes)));
  ASSERT_TRUE(engine->WaitUntilServing().ok());
  NewCollection cups;
  cups.id = "cups";
  cups.settings = QuickSettings();
  ASSERT_THAT(engine->CreateCollection(cups), IsOk());
  NewShape shape;
  shape.collection = "cups";
  shape.id = "red";
  ASSERT_THAT(engine->AddShape(shape, mesh), IsOk());
  ASSERT_THAT(engine->DeleteCollection({.id = "cups", .force = true}), IsOk());
  EXPECT_EQ(stored.size(), 1U) << "it is left";
  later.Notify();
  EXPECT_TRUE(Comes([&] { return leaving.left() == 0; }));
  EXPECT_TRUE(Comes([&] { return stored.size() == 0; }));
}

TEST(HousekeepingTest, GoesOnWithADeletedCollectionAfterARestart) {
  const TemporaryDirectory folder;
  const auto open = [&]() -> absl::StatusOr<std::unique_ptr<SqliteCatalog>> {
    ARGMESH_ASSIGN_OR_RETURN(
        std::shared_ptr<DataDirectory> directory,
        DataDirectory::Open(
            folder.path() / "data",
            {.min_free_bytes = 0, .allow_network_file_system = true}));
    SqliteCatalogOptions options;
    options.removed_at_once = 1;
    return SqliteCatalog::Open(std::move(directory), options);
  };
  ASSERT_OK_AND_ASSIGN(std::unique_ptr<SqliteCatalog> catalog, open());
  const CollectionRecord cups = SampleCollection("cups");
  ASSERT_THAT(catalog->InsertCollection(cups, {}), IsOk());
  for (uint64_t i = 0; i < 4; ++i) {
    ASSERT_THAT(catalog->PutShape(SamplePut(cups, "s" + std::to_string(i), i)),
                IsOk());
  }
  ASSERT_THAT(catalog->DeleteCollection({"cups", /*force=*/true, ""}), IsOk());
  ASSERT_THAT(catalog->RemoveSomeDeleted(), IsOk());
  ASSERT_THAT(catalog->Close(), IsOk());
  catalog.reset();

  ASSERT_OK_AND_ASSIGN(catalog, open());
  const SqliteCatalog& left = *catalog;
  ASSERT_EQ(left.Load().deleted_shapes, 3);
  ASSERT_OK_AND_ASSIGN(const std::unique_ptr<Engine> engine,
                       Engine::Create({}, std::move(catalog),
                                      std::make_unique<MemoryMeshStore>()));
  EXPECT_TRUE(Comes([&] { return left.Load().meshes == 0; }));
  EXPECT_EQ(left.Load().deleted_shapes, 0);
}

}  // namespace
}  // namespace argmesh
