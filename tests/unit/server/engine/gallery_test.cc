#include "server/engine/gallery.h"

#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "server/engine/error_reason.h"
#include "tests/support/catalog_samples.h"
#include "tests/support/memory_catalog.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;

class GalleryTest : public ::testing::Test {
 protected:
  GalleryTest() : pool_({.threads = {2, 1, 1, 1}}), gallery_(catalog_, pool_) {}

  CollectionRecord Insert(const std::string& id, int shapes) {
    const CollectionRecord record = SampleCollection(id);
    EXPECT_TRUE(catalog_.InsertCollection(record, {}).ok());
    for (int i = 0; i < shapes; ++i) Put(record, absl::StrCat("s", i));
    return record;
  }
  int64_t Put(const CollectionRecord& collection, const std::string& id) {
    ShapePut put = SamplePut(collection, id, 1);
    put.if_exists = IfExists::kReplace;
    return catalog_.PutShape(put).value().record.generation;
  }
  // Every shape has the mesh 1.
  void StageAll(const CollectionRecord& collection) {
    ASSERT_THAT(catalog_.BeginStage(collection.id, collection.uid, stage_),
                IsOk());
    ASSERT_OK_AND_ASSIGN(const std::vector<std::string> ids,
                         catalog_.ListUnstaged(collection.uid, "", 1000));
    for (const std::string& id : ids) {
      ASSERT_THAT(catalog_.StageShape(SampleStaging(collection, id, 1, stage_)),
                  IsOk());
    }
  }
  absl::StatusOr<std::optional<CollectionRecord>> SwitchInCatalog(
      const CollectionRecord& collection) {
    return catalog_.SwitchSettings(
        {collection.id, collection.uid, stage_, absl::UnixEpoch()});
  }
  int64_t SizeOf(const std::string& id) {
    return gallery_.Snapshot(id, 0).value()->size;
  }

  const SettingsStage stage_ = SampleStage(900);
  MemoryCatalog catalog_;
  ComputePool pool_;
  Gallery gallery_;
};

// Cannot read the graphs of one collection.
class TornCatalog : public MemoryCatalog {
 public:
  absl::StatusOr<std::vector<ScannedGraph>> ScanGraphs(
      std::string_view collection_uid, std::string_view after_id,
      int limit) const override {
    if (collection_uid == torn_uid) {
      return MakeError(ErrorReason::kStoredDataDamaged, "a torn page");
    }
    return MemoryCatalog::ScanGraphs(collection_uid, after_id, limit);
  }
  std::string torn_uid;
};

TEST(GalleryOfATornCatalog, ServesTheCollectionsThatItCanLoad) {
  TornCatalog catalog;
  for (const char* id : {"cups", "jugs"}) {
    const CollectionRecord record = SampleCollection(id);
    ASSERT_THAT(catalog.InsertCollection(record, {}), IsOk());
    ASSERT_THAT(catalog.PutShape(SamplePut(record, "s", 1)), IsOk());
    if (record.id == "cups") catalog.torn_uid = record.uid;
  }
  ComputePool pool({.threads = {1, 1, 1, 1}});
  Gallery gallery(catalog, pool);
  gallery.Load({});
  EXPECT_EQ(gallery.state(), IndexState::kServing);
  EXPECT_EQ(gallery.Snapshot("jugs", 0).value()->size, 1);
  EXPECT_EQ(ReasonOf(gallery.Snapshot("cups", 0).status()),
            ErrorReason::kStoredDataDamaged);
  const std::vector<CollectionHealth> health = gallery.Health();
  ASSERT_EQ(health.size(), 2U);
  EXPECT_FALSE(health[0].loaded);
  EXPECT_NE(health[0].error, "");
  EXPECT_EQ(health[1].error, "");
}

TEST(GalleryOfATornCatalog, LoadsACollectionOnceItCanBeRead) {
  TornCatalog catalog;
  const CollectionRecord cups = SampleCollection("cups");
  ASSERT_THAT(catalog.InsertCollection(cups, {}), IsOk());
  for (const char* id : {"gone", "kept"}) {
    ASSERT_THAT(catalog.PutShape(SamplePut(cups, id, 1)), IsOk());
  }
  catalog.torn_uid = cups.uid;
  ComputePool pool({.threads = {1, 1, 1, 1}});
  Gallery gallery(catalog, pool);
  gallery.Load({});
  EXPECT_FALSE(gallery.LoadMissing({}));
  // Writes go on meanwhile.
  ASSERT_OK_AND_ASSIGN(const ShapeDeleted deleted,
                       catalog.DeleteShape({"cups", "gone", "", {}}));
  gallery.Follow("cups", cups.uid, deleted.generation, std::nullopt);
  ASSERT_OK_AND_ASSIGN(const ShapeWritten put,
                       catalog.PutShape(SamplePut(cups, "new", 1)));
  gallery.Follow("cups", cups.uid, put.record.generation, std::nullopt);

  catalog.torn_uid.clear();
  EXPECT_TRUE(gallery.LoadMissing({}));
  ASSERT_OK_AND_ASSIGN(const GallerySnapshotPtr snapshot,
                       gallery.Snapshot("cups", put.record.generation));
  EXPECT_EQ(snapshot->size, 2);
  EXPECT_EQ(gallery.Health()[0].error, "");
}

TEST_F(GalleryTest, LoadsWhatIsStoredAndTellsWhenItIsDone) {
  std::vector<IndexState> states;
  gallery_.Watch([&](IndexState state) { states.push_back(state); });
  Insert("cups", 600);
  EXPECT_EQ(gallery_.Snapshot("cups", 0).status().code(),
            absl::StatusCode::kUnavailable);
  gallery_.Load({});
  EXPECT_THAT(states, ElementsAre(IndexState::kLoading, IndexState::kServing));
  ASSERT_OK_AND_ASSIGN(const GallerySnapshotPtr snapshot,
                       gallery_.Snapshot("cups", 600));
  EXPECT_EQ(snapshot->size, 600);
  EXPECT_EQ(snapshot->generation, 600);
  EXPECT_EQ(ReasonOf(gallery_.Snapshot("jugs", 0).status()),
            ErrorReason::kCollectionNotFound);
  gallery_.Close();
  EXPECT_EQ(states.back(), IndexState::kClosed);
}

TEST_F(GalleryTest, AppliesChangesInTheOrderOfTheirGenerations) {
  const CollectionRecord cups = Insert("cups", 0);
  gallery_.Load({});
  const int64_t put = Put(cups, "a");
  ASSERT_OK_AND_ASSIGN(const ShapeDeleted deleted,
                       catalog_.DeleteShape({"cups", "a", "", {}}));
  gallery_.Follow("cups", cups.uid, deleted.generation, std::nullopt);
  EXPECT_EQ(SizeOf("cups"), 0);
  // The earlier write is told last: the shape must not come back.
  gallery_.Follow("cups", cups.uid, put, std::nullopt);
  EXPECT_EQ(SizeOf("cups"), 0);
  EXPECT_EQ(gallery_.Snapshot("cups", 0).value()->generation,
            deleted.generation);
}

TEST_F(GalleryTest, LeavesOutDamagedShapesAndCountsThem) {
  Insert("cups", 3);
  Insert("jugs", 1);
  catalog_.DamageGraph("cups", "s1");
  gallery_.Load({});
  ASSERT_OK_AND_ASSIGN(const GallerySnapshotPtr snapshot,
                       gallery_.Snapshot("cups", 0));
  EXPECT_EQ(snapshot->size, 2);
  EXPECT_EQ(snapshot->damaged_shapes, 1);
  EXPECT_EQ(SizeOf("jugs"), 1);
  const std::vector<CollectionHealth> health = gallery_.Health();
  ASSERT_EQ(health.size(), 2U);
  EXPECT_EQ(health[0].id, "cups");
  EXPECT_TRUE(health[0].loaded);
  EXPECT_EQ(health[0].damaged_shapes, 1);
}

TEST_F(GalleryTest, LeavesOutGraphsOfAnotherVersion) {
  const CollectionRecord cups = Insert("cups", 1);
  ShapePut old = SamplePut(cups, "old", 2);
  old.graph_version = kShapeGraphVersion + 1;
  ASSERT_THAT(catalog_.PutShape(old), IsOk());
  gallery_.Load({});
  EXPECT_EQ(SizeOf("cups"), 1);
  EXPECT_EQ(gallery_.Snapshot("cups", 0).value()->outdated_shapes, 1);
}

TEST_F(GalleryTest, IgnoresNewsOfACollectionThatIsGone) {
  const CollectionRecord old = Insert("cups", 1);
  gallery_.Load({});
  ASSERT_THAT(catalog_.DeleteCollection({"cups", true, ""}), IsOk());
  gallery_.Remove(old.uid);
  const CollectionRecord cups = Insert("cups", 0);
  gallery_.Add(cups);
  gallery_.Follow("cups", old.uid, 9, std::nullopt);
  EXPECT_EQ(SizeOf("cups"), 0);
  EXPECT_EQ(gallery_.Snapshot("cups", 0).value()->generation, 0);
}

TEST_F(GalleryTest, SwitchesToWhatIsPutAsideAllAtOnce) {
  const CollectionRecord cups = Insert("cups", 300);
  gallery_.Load({});
  StageAll(cups);
  ASSERT_OK_AND_ASSIGN(const GallerySnapshotPtr before,
                       gallery_.Snapshot("cups", 0));
  ASSERT_OK_AND_ASSIGN(Gallery::StagedShapes staged,
                       gallery_.ReadStaged(cups, {}));
  EXPECT_EQ(staged.size(), 300U);
  const auto nothing = gallery_.Switch(
      cups, staged, [] { return std::optional<CollectionRecord>(); });
  ASSERT_THAT(nothing, IsOk());
  EXPECT_FALSE(nothing->has_value());
  EXPECT_EQ(gallery_.Snapshot("cups", 0).value(), before);

  ASSERT_OK_AND_ASSIGN(
      const std::optional<CollectionRecord> switched,
      gallery_.Switch(cups, staged, [&] { return SwitchInCatalog(cups); }));
  ASSERT_TRUE(switched.has_value());
  ASSERT_OK_AND_ASSIGN(const GallerySnapshotPtr after,
                       gallery_.Snapshot("cups", switched->generation));
  EXPECT_EQ(after->settings, stage_.settings);
  EXPECT_EQ(after->size, 300);
  for (const auto& block : after->blocks) {
    for (const GalleryEntryPtr& entry : *block) {
      const ShapeRecord stored =
          catalog_.GetShape("cups", entry->record.id).value();
      EXPECT_TRUE(SameRecord(entry->record, stored));
    }
  }
  EXPECT_EQ(before->settings, cups.settings);
  EXPECT_EQ(before->size, 300);
}

TEST_F(GalleryTest, NeverPutsAGraphOfNewSettingsAmongOldOnes) {
  const CollectionRecord cups = Insert("cups", 3);
  gallery_.Load({});
  const int64_t put = Put(cups, "new");
  StageAll(cups);
  ASSERT_OK_AND_ASSIGN(const std::optional<CollectionRecord> switched,
                       SwitchInCatalog(cups));
  // Of the put alone is told, and the switch after it has been committed.
  gallery_.Follow("cups", cups.uid, put, std::nullopt);
  ASSERT_OK_AND_ASSIGN(const GallerySnapshotPtr snapshot,
                       gallery_.LatestSnapshot("cups"));
  EXPECT_EQ(snapshot->generation, switched->generation);
  EXPECT_EQ(snapshot->settings, stage_.settings);
  EXPECT_EQ(snapshot->size, 4);
}

TEST_F(GalleryTest, StopsLoadingWhenAsked) {
  Insert("cups", 10);
  const StopToken stopped({}, absl::UnixEpoch());
  gallery_.Load(stopped);
  EXPECT_EQ(gallery_.state(), IndexState::kLoading);
  EXPECT_FALSE(gallery_.WaitUntilServing(stopped).ok());
}

}  // namespace
}  // namespace argmesh
