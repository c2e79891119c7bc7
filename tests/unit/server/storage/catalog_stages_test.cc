// What every Catalog promises of other settings for a collection.
#include <string>
#include <vector>

#include "server/engine/catalog.h"
#include "server/engine/error_reason.h"
#include "tests/support/catalog_samples.h"
#include "tests/support/status_matchers.h"
#include "tests/unit/server/storage/catalog_bench.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class CatalogStagesTest : public CatalogPortTest {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(CatalogPortTest::SetUp());
    ASSERT_THAT(catalog_->InsertCollection(cups_, {}), IsOk());
    ASSERT_THAT(catalog_->PutShape(SamplePut(cups_, "blue", 1)), IsOk());
    ASSERT_THAT(catalog_->PutShape(SamplePut(cups_, "red", 2)), IsOk());
  }

  absl::Status Begin(const SettingsStage& stage) {
    return catalog_->BeginStage("cups", cups_.uid, stage);
  }
  absl::Status Stage(const std::string& id, uint64_t mesh) {
    return catalog_->StageShape(SampleStaging(cups_, id, mesh, stage_));
  }
  absl::StatusOr<std::optional<CollectionRecord>> Switch() {
    return catalog_->SwitchSettings({"cups", cups_.uid, stage_, switch_time_});
  }
  std::vector<std::string> Unstaged() {
    return catalog_->ListUnstaged(cups_.uid, "", 10).value();
  }
  std::string GraphOf(const std::string& id) {
    return catalog_->ReadGraph("cups", id, false).value().graph;
  }

  const absl::Time switch_time_ = absl::FromUnixSeconds(1'800'000'000);
  const CollectionRecord cups_ = SampleCollection("cups");
  const SettingsStage stage_ = SampleStage(900);
};

INSTANTIATE_TEST_SUITE_P(Catalogs, CatalogStagesTest,
                         ::testing::Values(CatalogKind::kMemory,
                                           CatalogKind::kSqlite),
                         CatalogKindName);

TEST_P(CatalogStagesTest, SwitchesEveryShapeAtOnceWhenNoneIsMissing) {
  ASSERT_OK_AND_ASSIGN(const ShapeRecord before,
                       catalog_->GetShape("cups", "red"));
  ASSERT_OK_AND_ASSIGN(const StoredGraph graph_before,
                       catalog_->ReadGraph("cups", "red", true));
  EXPECT_EQ(graph_before.settings, cups_.settings);
  ASSERT_THAT(Begin(stage_), IsOk());
  EXPECT_THAT(Unstaged(), ElementsAre("blue", "red"));
  ASSERT_THAT(Stage("red", 2), IsOk());
  EXPECT_THAT(Unstaged(), ElementsAre("blue"));
  ASSERT_OK_AND_ASSIGN(std::optional<CollectionRecord> switched, Switch());
  EXPECT_FALSE(switched.has_value());
  EXPECT_EQ(GraphOf("red"), graph_before.graph);
  ASSERT_THAT(Stage("blue", 1), IsOk());

  ASSERT_OK_AND_ASSIGN(switched, Switch());
  ASSERT_TRUE(switched.has_value());
  EXPECT_EQ(switched->settings, stage_.settings);
  EXPECT_EQ(switched->generation, 3);
  EXPECT_EQ(switched->shape_count, 2);
  EXPECT_EQ(switched->revision, 2);
  EXPECT_EQ(switched->update_time, switch_time_);
  EXPECT_EQ(*switched, catalog_->GetCollection("cups").value());
  const StagedDescription red = SampleDescription(stage_, 2);
  ASSERT_OK_AND_ASSIGN(const StoredGraph after,
                       catalog_->ReadGraph("cups", "red", true));
  EXPECT_EQ(after.graph, red.graph);
  EXPECT_EQ(after.labels, red.labels);
  EXPECT_EQ(after.settings, stage_.settings);
  EXPECT_EQ(after.signature, graph_before.signature);
  ShapeRecord expected = before;
  expected.report = red.report;
  expected.graph = red.summary;
  expected.generation = 3;
  expected.update_time = switch_time_;
  EXPECT_TRUE(SameRecord(after.record, expected));
  EXPECT_NE(ShapeEtag(after.record), ShapeEtag(before));
  ASSERT_OK_AND_ASSIGN(const std::vector<ShapeChange> changes,
                       catalog_->ReadChanges(cups_.uid, 2, 10));
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].kind, ShapeChange::Kind::kSwitch);
  EXPECT_EQ(changes[0].generation, 3);
  EXPECT_EQ(changes[0].id, "");
  EXPECT_EQ(ReasonOrOk(Switch()), ErrorReason::kGraphVersionMismatch);
}

TEST_P(CatalogStagesTest, ScansWhatIsPutAside) {
  ASSERT_THAT(Begin(stage_), IsOk());
  ASSERT_THAT(Stage("red", 2), IsOk());
  ASSERT_OK_AND_ASSIGN(const std::vector<ScannedGraph> staged,
                       catalog_->ScanStaged(cups_.uid, "", 10));
  ASSERT_EQ(staged.size(), 1U);
  const ShapePut put = SamplePut(cups_, "red", 2);
  const StagedDescription red = SampleDescription(stage_, 2);
  EXPECT_THAT(staged[0].status, IsOk());
  EXPECT_EQ(staged[0].record.id, "red");
  EXPECT_EQ(staged[0].record.graph, red.summary);
  EXPECT_EQ(staged[0].settings, stage_.settings);
  EXPECT_EQ(staged[0].graph, red.graph);
  EXPECT_EQ(staged[0].signature, put.descriptors.signature);
  EXPECT_EQ(staged[0].window_words, put.descriptors.window_words);
  ASSERT_OK_AND_ASSIGN(const std::vector<ScannedGraph> rest,
                       catalog_->ScanStaged(cups_.uid, "red", 10));
  EXPECT_THAT(rest, IsEmpty());
}

TEST_P(CatalogStagesTest, MissesShapesThatCameOrGotAnotherMeshMeanwhile) {
  ASSERT_THAT(Begin(stage_), IsOk());
  ASSERT_THAT(Stage("red", 2), IsOk());
  ASSERT_THAT(Stage("blue", 1), IsOk());
  ShapePut replaced = SamplePut(cups_, "red", 7);
  replaced.if_exists = IfExists::kReplace;
  ASSERT_THAT(catalog_->PutShape(replaced), IsOk());
  ASSERT_THAT(catalog_->PutShape(SamplePut(cups_, "new", 3)), IsOk());
  EXPECT_THAT(Unstaged(), ElementsAre("new", "red"));
  ASSERT_OK_AND_ASSIGN(const std::optional<CollectionRecord> refused, Switch());
  EXPECT_FALSE(refused.has_value());
  EXPECT_EQ(ReasonOrOk(Stage("red", 2)), ErrorReason::kEtagMismatch);
  ASSERT_THAT(Stage("red", 7), IsOk());
  ASSERT_THAT(catalog_->DeleteShape({"cups", "new", "", {}}), IsOk());
  EXPECT_THAT(Unstaged(), IsEmpty());
  ASSERT_OK_AND_ASSIGN(const std::optional<CollectionRecord> done, Switch());
  ASSERT_TRUE(done.has_value());
  EXPECT_EQ(GraphOf("red"), SampleDescription(stage_, 7).graph);
}

TEST_P(CatalogStagesTest, KeepsWhatIsPutAsideWhenTheMeshStaysTheSame) {
  ASSERT_THAT(Begin(stage_), IsOk());
  ASSERT_THAT(Stage("red", 2), IsOk());
  ASSERT_THAT(Stage("blue", 1), IsOk());
  ShapePut again = SamplePut(cups_, "red", 2);
  again.if_exists = IfExists::kReplace;
  again.record.metadata = {{"colour", "red"}};
  ASSERT_THAT(catalog_->PutShape(again), IsOk());
  ShapePatch patch;
  patch.collection = "cups";
  patch.id = "blue";
  patch.display_name = "Blue";
  ASSERT_THAT(catalog_->UpdateShape(patch), IsOk());
  ASSERT_OK_AND_ASSIGN(const std::optional<CollectionRecord> done, Switch());
  ASSERT_TRUE(done.has_value());
  EXPECT_EQ(catalog_->GetShape("cups", "red").value().metadata.at("colour"),
            "red");
  EXPECT_EQ(catalog_->GetShape("cups", "blue").value().display_name, "Blue");
  EXPECT_EQ(GraphOf("red"), SampleDescription(stage_, 2).graph);
}

TEST_P(CatalogStagesTest, PutsAsideWithAShapeOnlyAtItsStage) {
  ShapePut put = SamplePut(cups_, "new", 3);
  put.staged = SampleDescription(stage_, 3);
  ASSERT_THAT(catalog_->PutShape(put), IsOk());
  EXPECT_THAT(Unstaged(), ElementsAre("blue", "new", "red"));
  ASSERT_THAT(Begin(stage_), IsOk());
  put.if_exists = IfExists::kReplace;
  ASSERT_THAT(catalog_->PutShape(put), IsOk());
  EXPECT_THAT(Unstaged(), ElementsAre("blue", "red"));
  ShapePut other = SamplePut(cups_, "other", 3);
  other.staged = SampleDescription(SampleStage(700), 3);
  ASSERT_THAT(catalog_->PutShape(other), IsOk());
  EXPECT_THAT(Unstaged(), ElementsAre("blue", "other", "red"));
}

TEST_P(CatalogStagesTest, GoesOnWithTheSameStageAndForgetsAnother) {
  ASSERT_THAT(Begin(stage_), IsOk());
  ASSERT_THAT(Stage("red", 2), IsOk());
  ASSERT_THAT(Begin(stage_), IsOk());
  EXPECT_THAT(Unstaged(), ElementsAre("blue"));
  SettingsStage newer = stage_;
  ++newer.graph_version;
  ASSERT_THAT(Begin(newer), IsOk());
  EXPECT_THAT(Unstaged(), ElementsAre("blue", "red"));
  EXPECT_EQ(ReasonOrOk(Stage("red", 2)), ErrorReason::kGraphVersionMismatch);
  ASSERT_THAT(Begin(stage_), IsOk());
  ASSERT_THAT(Stage("red", 2), IsOk());
  // The collection's own settings: no stage at all.
  ASSERT_THAT(Begin({cups_.settings, cups_.graph_version}), IsOk());
  EXPECT_THAT(Unstaged(), ElementsAre("blue", "red"));
  EXPECT_EQ(ReasonOrOk(Switch()), ErrorReason::kGraphVersionMismatch);
  EXPECT_EQ(catalog_->GetCollection("cups").value().revision, 1);
}

TEST_P(CatalogStagesTest, SwitchesACollectionWithoutShapes) {
  ASSERT_THAT(catalog_->DeleteShapes({"cups", {"blue", "red"}}), IsOk());
  ASSERT_THAT(Begin(stage_), IsOk());
  ASSERT_OK_AND_ASSIGN(const std::optional<CollectionRecord> done, Switch());
  ASSERT_TRUE(done.has_value());
  EXPECT_EQ(done->settings, stage_.settings);
}

TEST_P(CatalogStagesTest, TakesNoGraphOfOtherSettings) {
  ShapePut put = SamplePut(cups_, "new", 3);
  put.settings = stage_.settings;
  EXPECT_EQ(ReasonOrOk(catalog_->PutShape(put)),
            ErrorReason::kGraphVersionMismatch);
  EXPECT_EQ(ReasonOrOk(catalog_->GetShape("cups", "new")),
            ErrorReason::kShapeNotFound);
  put.settings = cups_.settings;
  put.settings.store_meshes = !put.settings.store_meshes;
  EXPECT_THAT(catalog_->PutShape(put), IsOk());
}

TEST_P(CatalogStagesTest, NamesWhatIsMissing) {
  EXPECT_EQ(ReasonOrOk(catalog_->BeginStage("jugs", cups_.uid, stage_)),
            ErrorReason::kCollectionNotFound);
  EXPECT_EQ(ReasonOrOk(catalog_->BeginStage("cups", "another", stage_)),
            ErrorReason::kCollectionNotFound);
  EXPECT_EQ(ReasonOrOk(Stage("red", 2)), ErrorReason::kGraphVersionMismatch);
  ASSERT_THAT(Begin(stage_), IsOk());
  EXPECT_EQ(ReasonOrOk(Stage("green", 2)), ErrorReason::kShapeNotFound);
  EXPECT_EQ(ReasonOrOk(catalog_->SwitchSettings(
                {"cups", "another", stage_, switch_time_})),
            ErrorReason::kCollectionNotFound);
  ASSERT_OK_AND_ASSIGN(const std::vector<std::string> nobodys,
                       catalog_->ListUnstaged("another", "", 10));
  EXPECT_THAT(nobodys, IsEmpty());
}

TEST_P(CatalogStagesTest, LeavesNothingOfADeletedCollection) {
  ASSERT_THAT(Begin(stage_), IsOk());
  ASSERT_THAT(Stage("red", 2), IsOk());
  ASSERT_THAT(catalog_->DeleteCollection({"cups", true, ""}), IsOk());
  ASSERT_THAT(catalog_->InsertCollection(cups_, {}), IsOk());
  EXPECT_EQ(ReasonOrOk(Switch()), ErrorReason::kGraphVersionMismatch);
  ASSERT_THAT(catalog_->PutShape(SamplePut(cups_, "red", 2)), IsOk());
  ASSERT_THAT(Begin(stage_), IsOk());
  EXPECT_THAT(Unstaged(), ElementsAre("red"));
}

}  // namespace
}  // namespace argmesh
