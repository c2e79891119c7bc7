// What every Catalog promises, whatever it is made of.
#include <map>
#include <string>
#include <vector>

#include "core/graph/graph_codec.h"
#include "server/engine/catalog.h"
#include "server/engine/error_reason.h"
#include "tests/support/catalog_samples.h"
#include "tests/support/status_matchers.h"
#include "tests/unit/server/storage/catalog_bench.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> IdsOf(const std::vector<ShapeRecord>& records) {
  std::vector<std::string> ids;
  for (const ShapeRecord& record : records) ids.push_back(record.id);
  return ids;
}

INSTANTIATE_TEST_SUITE_P(Catalogs, CatalogPortTest,
                         ::testing::Values(CatalogKind::kMemory,
                                           CatalogKind::kSqlite),
                         CatalogKindName);

TEST_P(CatalogPortTest, GivesBackACollectionAsItWasStored) {
  const CollectionRecord cups = SampleCollection("cups");
  ASSERT_OK_AND_ASSIGN(const CollectionRecord stored,
                       catalog_->InsertCollection(cups, {}));
  EXPECT_EQ(stored, cups);
  ASSERT_OK_AND_ASSIGN(const CollectionRecord read,
                       catalog_->GetCollection("cups"));
  EXPECT_EQ(read, cups);
}

TEST_P(CatalogPortTest, RefusesATakenCollectionIdAndAnUnknownOne) {
  ASSERT_THAT(catalog_->InsertCollection(SampleCollection("cups"), {}), IsOk());
  EXPECT_EQ(
      ReasonOrOk(catalog_->InsertCollection(SampleCollection("cups"), {})),
      ErrorReason::kCollectionExists);
  EXPECT_EQ(ReasonOrOk(catalog_->GetCollection("jugs")),
            ErrorReason::kCollectionNotFound);
}

TEST_P(CatalogPortTest, ListsCollectionsByIdFromAnyPlace) {
  for (const char* id : {"b", "d", "a", "c"}) {
    ASSERT_THAT(catalog_->InsertCollection(SampleCollection(id), {}), IsOk());
  }
  ASSERT_OK_AND_ASSIGN(const std::vector<CollectionRecord> first,
                       catalog_->ListCollections("", 2));
  ASSERT_EQ(first.size(), 2U);
  EXPECT_EQ(first[0].id, "a");
  ASSERT_OK_AND_ASSIGN(const std::vector<CollectionRecord> rest,
                       catalog_->ListCollections(first[1].id, 10));
  ASSERT_EQ(rest.size(), 2U);
  EXPECT_EQ(rest[1].id, "d");
}

TEST_P(CatalogPortTest, RefusesAMetadataValueThatHasNotItsDeclaredType) {
  CollectionRecord cups = SampleCollection("cups");
  cups.metadata_keys = {{"mass", MetadataType::kNumber}};
  ASSERT_THAT(catalog_->InsertCollection(cups, {}), IsOk());
  ShapePut put = SamplePut(cups, "red", 1);
  put.record.metadata = {{"mass", "heavy"}};
  EXPECT_EQ(ReasonOrOk(catalog_->PutShape(put)), ErrorReason::kFieldInvalid);
  EXPECT_EQ(ReasonOrOk(catalog_->GetShape("cups", "red")),
            ErrorReason::kShapeNotFound);
  put.record.metadata = {{"mass", "3"}};
  ASSERT_THAT(catalog_->PutShape(put), IsOk());
  ShapePatch patch;
  patch.collection = "cups";
  patch.id = "red";
  patch.metadata = std::map<std::string, std::string>{{"mass", ""}};
  EXPECT_EQ(ReasonOrOk(catalog_->UpdateShape(patch)),
            ErrorReason::kFieldInvalid);
  ASSERT_OK_AND_ASSIGN(const ShapeRecord red,
                       catalog_->GetShape("cups", "red"));
  EXPECT_EQ(red.metadata.at("mass"), "3");
}

TEST_P(CatalogPortTest, RefusesATypeThatAStoredValueHasNot) {
  const CollectionRecord cups = SampleCollection("cups");
  ASSERT_THAT(catalog_->InsertCollection(cups, {}), IsOk());
  ShapePut put = SamplePut(cups, "red", 1);
  put.record.metadata = {{"mass", "heavy"}};
  ASSERT_THAT(catalog_->PutShape(put), IsOk());
  CollectionPatch patch;
  patch.id = "cups";
  patch.metadata_keys = std::vector<MetadataKey>{{"mass", MetadataType::kBool}};
  const auto refused = catalog_->UpdateCollection(patch);
  EXPECT_EQ(ReasonOrOk(refused), ErrorReason::kFieldInvalid);
  EXPECT_EQ(MetadataOf(refused.status()).at("shape"), "red");
  ASSERT_OK_AND_ASSIGN(const CollectionRecord read,
                       catalog_->GetCollection("cups"));
  EXPECT_THAT(read.metadata_keys, IsEmpty());
  patch.metadata_keys->front().type = MetadataType::kString;
  ASSERT_OK_AND_ASSIGN(const CollectionRecord declared,
                       catalog_->UpdateCollection(patch));
  EXPECT_EQ(declared.metadata_keys, *patch.metadata_keys);
  EXPECT_EQ(declared.display_name, cups.display_name);
}

TEST_P(CatalogPortTest, UpdatesACollectionOnlyUnderItsEtag) {
  ASSERT_OK_AND_ASSIGN(
      const CollectionRecord cups,
      catalog_->InsertCollection(SampleCollection("cups"), {}));
  CollectionPatch patch{.id = "cups",
                        .display_name = "Mugs",
                        .metadata_keys = std::nullopt,
                        .graph_version = cups.graph_version + 1,
                        .etag = CollectionEtag(cups),
                        .update_time = cups.update_time + absl::Seconds(1)};
  ASSERT_OK_AND_ASSIGN(const CollectionRecord updated,
                       catalog_->UpdateCollection(patch));
  EXPECT_EQ(updated.display_name, "Mugs");
  EXPECT_EQ(updated.graph_version, cups.graph_version + 1);
  EXPECT_EQ(updated.update_time, patch.update_time);
  EXPECT_EQ(ReasonOrOk(catalog_->UpdateCollection(patch)),
            ErrorReason::kEtagMismatch);
}

TEST_P(CatalogPortTest, GivesBackAShapeWithItsGraphAndLabels) {
  const CollectionRecord cups = SampleCollection("cups");
  ASSERT_THAT(catalog_->InsertCollection(cups, {}), IsOk());
  const ShapePut put = SamplePut(cups, "red", 1);
  ASSERT_OK_AND_ASSIGN(const ShapeWritten written, catalog_->PutShape(put));
  EXPECT_TRUE(written.written);
  EXPECT_EQ(written.collection_uid, cups.uid);
  EXPECT_EQ(written.record.generation, 1);
  ASSERT_OK_AND_ASSIGN(const ShapeRecord record,
                       catalog_->GetShape("cups", "red"));
  EXPECT_TRUE(SameRecord(record, written.record));
  ASSERT_OK_AND_ASSIGN(const StoredGraph full,
                       catalog_->ReadGraph("cups", "red", true));
  EXPECT_EQ(full.graph, put.graph);
  EXPECT_EQ(full.labels, put.labels);
  EXPECT_EQ(full.graph_version, put.graph_version);
  ASSERT_OK_AND_ASSIGN(const StoredGraph bare,
                       catalog_->ReadGraph("cups", "red", false));
  EXPECT_EQ(bare.labels, "");
  ASSERT_OK_AND_ASSIGN(const CollectionRecord after,
                       catalog_->GetCollection("cups"));
  EXPECT_EQ(after.shape_count, 1);
  EXPECT_EQ(after.generation, 1);
}

TEST_P(CatalogPortTest, GivesBackWhatDescribesTheSurface) {
  const CollectionRecord cups = SampleCollection("cups");
  ASSERT_THAT(catalog_->InsertCollection(cups, {}), IsOk());
  ShapePut put = SamplePut(cups, "red", 1);
  ASSERT_THAT(catalog_->PutShape(put), IsOk());
  ASSERT_OK_AND_ASSIGN(const ScannedGraph scanned,
                       catalog_->FindGraph(cups.uid, "red"));
  EXPECT_EQ(scanned.signature, put.descriptors.signature);
  EXPECT_EQ(scanned.window_words, put.descriptors.window_words);
  ASSERT_OK_AND_ASSIGN(const StoredGraph stored,
                       catalog_->ReadGraph("cups", "red", false));
  EXPECT_EQ(stored.signature, put.descriptors.signature);
  EXPECT_EQ(catalog_->ReadWindows(cups.uid, "red").value(),
            put.descriptors.windows);

  // A shape that takes its place leaves nothing of it.
  put.descriptors = {};
  put.if_exists = IfExists::kReplace;
  ASSERT_THAT(catalog_->PutShape(put), IsOk());
  ASSERT_OK_AND_ASSIGN(const ScannedGraph bare,
                       catalog_->FindGraph(cups.uid, "red"));
  EXPECT_THAT(bare.status, IsOk());
  EXPECT_EQ(bare.signature, "");
  EXPECT_EQ(bare.window_words, "");
  EXPECT_EQ(catalog_->ReadWindows(cups.uid, "red").value(), "");
  EXPECT_EQ(ReasonOf(catalog_->ReadWindows(cups.uid, "green").status()),
            ErrorReason::kShapeNotFound);
}

TEST_P(CatalogPortTest, NamesWhatIsMissing) {
  const CollectionRecord cups = SampleCollection("cups");
  ASSERT_THAT(catalog_->InsertCollection(cups, {}), IsOk());
  EXPECT_EQ(ReasonOrOk(catalog_->GetShape("cups", "red")),
            ErrorReason::kShapeNotFound);
  EXPECT_EQ(ReasonOrOk(catalog_->GetShape("jugs", "red")),
            ErrorReason::kCollectionNotFound);
  EXPECT_EQ(ReasonOrOk(catalog_->ReadGraph("cups", "red", true)),
            ErrorReason::kShapeNotFound);
  EXPECT_EQ(ReasonOrOk(catalog_->ListShapes("jugs", {"", 1, ""})),
            ErrorReason::kCollectionNotFound);
  EXPECT_EQ(ReasonOrOk(catalog_->FindGraph(cups.uid, "red")),
            ErrorReason::kShapeNotFound);
  EXPECT_EQ(ReasonOrOk(catalog_->DeleteShape({"cups", "red", "", {}})),
            ErrorReason::kShapeNotFound);
  EXPECT_EQ(ReasonOrOk(catalog_->UpdateShape({.collection = "cups",
                                              .id = "red",
                                              .display_name = {},
                                              .source_uri = {},
                                              .metadata = {},
                                              .etag = "",
                                              .update_time = {}})),
            ErrorReason::kShapeNotFound);
  EXPECT_EQ(ReasonOrOk(catalog_->PutShape(
                SamplePut(SampleCollection("jugs"), "red", 1))),
            ErrorReason::kCollectionNotFound);
}

TEST_P(CatalogPortTest, PutsNothingIntoACollectionThatTookTheIdOfAnother) {
  const CollectionRecord old = SampleCollection("cups");
  ASSERT_THAT(catalog_->InsertCollection(old, {}), IsOk());
  ASSERT_THAT(catalog_->DeleteCollection({"cups", false, ""}), IsOk());
  ASSERT_THAT(catalog_->InsertCollection(SampleCollection("cups"), {}), IsOk());
  EXPECT_EQ(ReasonOrOk(catalog_->PutShape(SamplePut(old, "red", 1))),
            ErrorReason::kCollectionNotFound);
}

TEST_P(CatalogPortTest, AnswersATakenShapeIdByThePolicyAskedFor) {
  const CollectionRecord cups = SampleCollection("cups");
  ASSERT_THAT(catalog_->InsertCollection(cups, {}), IsOk());
  ASSERT_OK_AND_ASSIGN(const ShapeWritten first,
                       catalog_->PutShape(SamplePut(cups, "red", 1)));
  ShapePut again = SamplePut(cups, "red", 1);
  EXPECT_EQ(ReasonOrOk(catalog_->PutShape(again)), ErrorReason::kShapeExists);

  again.if_exists = IfExists::kReturnSame;
  ASSERT_OK_AND_ASSIGN(const ShapeWritten same, catalog_->PutShape(again));
  EXPECT_FALSE(same.written);
  EXPECT_TRUE(SameRecord(same.record, first.record));

  ShapePut other = SamplePut(cups, "red", 2);
  other.if_exists = IfExists::kReturnSame;
  EXPECT_EQ(ReasonOrOk(catalog_->PutShape(other)), ErrorReason::kShapeExists);

  other.if_exists = IfExists::kReplace;
  other.etag = "another";
  EXPECT_EQ(ReasonOrOk(catalog_->PutShape(other)), ErrorReason::kEtagMismatch);
  other.etag = ShapeEtag(first.record);
  ASSERT_OK_AND_ASSIGN(const ShapeWritten replaced, catalog_->PutShape(other));
  EXPECT_TRUE(replaced.written);
  EXPECT_EQ(replaced.record.uid, first.record.uid);
  EXPECT_EQ(replaced.record.create_time, first.record.create_time);
  EXPECT_EQ(replaced.record.sha256, other.record.sha256);
  EXPECT_EQ(replaced.record.generation, 2);
  EXPECT_THAT(replaced.unreferenced, ElementsAre(first.record.sha256));
  ASSERT_OK_AND_ASSIGN(const StoredGraph graph,
                       catalog_->ReadGraph("cups", "red", true));
  EXPECT_EQ(graph.graph, other.graph);
  EXPECT_EQ(graph.labels, other.labels);
  ASSERT_OK_AND_ASSIGN(const CollectionRecord after,
                       catalog_->GetCollection("cups"));
  EXPECT_EQ(after.shape_count, 1);
}

TEST_P(CatalogPortTest, RefusesToReplaceByEtagWhatIsNotThere) {
  const CollectionRecord cups = SampleCollection("cups");
  ASSERT_THAT(catalog_->InsertCollection(cups, {}), IsOk());
  ShapePut put = SamplePut(cups, "red", 1);
  put.if_exists = IfExists::kReplace;
  put.etag = "1-00000000";
  EXPECT_EQ(ReasonOrOk(catalog_->PutShape(put)), ErrorReason::kShapeNotFound);
}

TEST_P(CatalogPortTest, UpdatesAShapeAndLeavesItsGraph) {
  const CollectionRecord cups = SampleCollection("cups");
  ASSERT_THAT(catalog_->InsertCollection(cups, {}), IsOk());
  const ShapePut put = SamplePut(cups, "red", 1);
  ASSERT_OK_AND_ASSIGN(const ShapeWritten first, catalog_->PutShape(put));
  ShapePatch patch{.collection = "cups",
                   .id = "red",
                   .display_name = {},
                   .source_uri = {},
                   .metadata = std::map<std::string, std::string>{{"a", "b"}},
                   .etag = ShapeEtag(first.record),
                   .update_time = first.record.update_time + absl::Hours(1)};
  ASSERT_OK_AND_ASSIGN(const ShapeWritten updated,
                       catalog_->UpdateShape(patch));
  EXPECT_EQ(updated.record.metadata, *patch.metadata);
  EXPECT_EQ(updated.record.display_name, first.record.display_name);
  EXPECT_EQ(updated.record.generation, 2);
  ASSERT_OK_AND_ASSIGN(const StoredGraph stored,
                       catalog_->ReadGraph("cups", "red", true));
  EXPECT_TRUE(SameRecord(stored.record, updated.record));
  EXPECT_EQ(stored.graph, put.graph);
  EXPECT_EQ(ReasonOrOk(catalog_->UpdateShape(patch)),
            ErrorReason::kEtagMismatch);
}

TEST_P(CatalogPortTest, KeepsAMeshThatAnotherShapeStillNames) {
  const CollectionRecord cups = SampleCollection("cups");
  const CollectionRecord jugs = SampleCollection("jugs");
  ASSERT_THAT(catalog_->InsertCollection(cups, {}), IsOk());
  ASSERT_THAT(catalog_->InsertCollection(jugs, {}), IsOk());
  const ShapePut put = SamplePut(cups, "red", 7);
  ASSERT_THAT(catalog_->PutShape(put), IsOk());
  ASSERT_THAT(catalog_->PutShape(SamplePut(jugs, "red", 7)), IsOk());
  ASSERT_OK_AND_ASSIGN(const ShapeDeleted first,
                       catalog_->DeleteShape({"cups", "red", "", {}}));
  EXPECT_THAT(first.unreferenced, IsEmpty());
  ASSERT_OK_AND_ASSIGN(const bool referenced,
                       catalog_->IsMeshReferenced(put.record.sha256));
  EXPECT_TRUE(referenced);
  ASSERT_OK_AND_ASSIGN(const CollectionDeleted last,
                       catalog_->DeleteCollection({"jugs", true, ""}));
  EXPECT_EQ(last.uid, jugs.uid);
  EXPECT_THAT(last.unreferenced, ElementsAre(put.record.sha256));
  ASSERT_OK_AND_ASSIGN(const bool still,
                       catalog_->IsMeshReferenced(put.record.sha256));
  EXPECT_FALSE(still);
}

TEST_P(CatalogPortTest, NamesNoMeshOfACollectionThatKeepsNone) {
  const CollectionRecord cups = SampleCollection("cups");
  ASSERT_THAT(catalog_->InsertCollection(cups, {}), IsOk());
  ShapePut put = SamplePut(cups, "red", 1);
  put.record.mesh_stored = false;
  ASSERT_THAT(catalog_->PutShape(put), IsOk());
  ASSERT_OK_AND_ASSIGN(const bool referenced,
                       catalog_->IsMeshReferenced(put.record.sha256));
  EXPECT_FALSE(referenced);
  ASSERT_OK_AND_ASSIGN(const ShapeRecord record,
                       catalog_->GetShape("cups", "red"));
  EXPECT_FALSE(record.mesh_stored);
  EXPECT_EQ(record.sha256, put.record.sha256);
}

TEST_P(CatalogPortTest, DeletesACollectionWithShapesOnlyByForce) {
  const CollectionRecord cups = SampleCollection("cups");
  ASSERT_THAT(catalog_->InsertCollection(cups, {}), IsOk());
  ASSERT_THAT(catalog_->PutShape(SamplePut(cups, "red", 1)), IsOk());
  EXPECT_EQ(ReasonOrOk(catalog_->DeleteCollection({"cups", false, ""})),
            ErrorReason::kCollectionNotEmpty);
  EXPECT_EQ(ReasonOrOk(catalog_->DeleteCollection({"cups", true, "1-0"})),
            ErrorReason::kEtagMismatch);
  ASSERT_THAT(catalog_->DeleteCollection({"cups", true, ""}), IsOk());
  EXPECT_EQ(ReasonOrOk(catalog_->GetShape("cups", "red")),
            ErrorReason::kCollectionNotFound);
  ASSERT_OK_AND_ASSIGN(const std::vector<ShapeChange> changes,
                       catalog_->ReadChanges(cups.uid, 0, 10));
  EXPECT_THAT(changes, IsEmpty());
}

TEST_P(CatalogPortTest, ReplaysTheChangesInOrderWithoutGaps) {
  const CollectionRecord cups = SampleCollection("cups");
  ASSERT_THAT(catalog_->InsertCollection(cups, {}), IsOk());
  ASSERT_THAT(catalog_->PutShape(SamplePut(cups, "red", 1)), IsOk());
  ASSERT_THAT(catalog_->PutShape(SamplePut(cups, "blue", 2)), IsOk());
  EXPECT_FALSE(catalog_->PutShape(SamplePut(cups, "blue", 3)).ok());
  ASSERT_OK_AND_ASSIGN(const ShapeDeleted deleted,
                       catalog_->DeleteShape({"cups", "red", "", {}}));
  EXPECT_EQ(deleted.generation, 3);
  ASSERT_OK_AND_ASSIGN(const std::vector<ShapeChange> changes,
                       catalog_->ReadChanges(cups.uid, 1, 10));
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[0].generation, 2);
  EXPECT_EQ(changes[0].id, "blue");
  EXPECT_EQ(changes[0].kind, ShapeChange::Kind::kPut);
  EXPECT_EQ(changes[1].generation, 3);
  EXPECT_EQ(changes[1].kind, ShapeChange::Kind::kDelete);
  ASSERT_OK_AND_ASSIGN(const std::vector<ShapeChange> one,
                       catalog_->ReadChanges(cups.uid, 0, 1));
  EXPECT_EQ(one.size(), 1U);
}

TEST_P(CatalogPortTest, ListsEveryShapeThatStaysExactlyOnceUnderInserts) {
  const CollectionRecord cups = SampleCollection("cups");
  ASSERT_THAT(catalog_->InsertCollection(cups, {}), IsOk());
  for (const char* id : {"b", "d", "f", "h"}) {
    ASSERT_THAT(catalog_->PutShape(SamplePut(cups, id, 1)), IsOk());
  }
  ASSERT_OK_AND_ASSIGN(const std::vector<ShapeRecord> first,
                       catalog_->ListShapes("cups", {"", 2, ""}));
  EXPECT_THAT(IdsOf(first), ElementsAre("b", "d"));
  for (const char* id : {"a", "c", "e"}) {
    ASSERT_THAT(catalog_->PutShape(SamplePut(cups, id, 1)), IsOk());
  }
  ASSERT_OK_AND_ASSIGN(const std::vector<ShapeRecord> second,
                       catalog_->ListShapes("cups", {"d", 2, ""}));
  EXPECT_THAT(IdsOf(second), ElementsAre("e", "f"));
  ASSERT_OK_AND_ASSIGN(const std::vector<ShapeRecord> third,
                       catalog_->ListShapes("cups", {"f", 2, ""}));
  EXPECT_THAT(IdsOf(third), ElementsAre("h"));
}

TEST_P(CatalogPortTest, ScansTheGraphsOfOneCollectionOnly) {
  const CollectionRecord cups = SampleCollection("cups");
  const CollectionRecord jugs = SampleCollection("jugs");
  ASSERT_THAT(catalog_->InsertCollection(cups, {}), IsOk());
  ASSERT_THAT(catalog_->InsertCollection(jugs, {}), IsOk());
  const ShapePut red = SamplePut(cups, "red", 1);
  ASSERT_THAT(catalog_->PutShape(red), IsOk());
  ASSERT_THAT(catalog_->PutShape(SamplePut(cups, "blue", 2)), IsOk());
  ASSERT_THAT(catalog_->PutShape(SamplePut(jugs, "green", 3)), IsOk());
  ASSERT_OK_AND_ASSIGN(const std::vector<ScannedGraph> scanned,
                       catalog_->ScanGraphs(cups.uid, "", 10));
  ASSERT_EQ(scanned.size(), 2U);
  EXPECT_EQ(scanned[0].record.id, "blue");
  EXPECT_THAT(scanned[1].status, IsOk());
  EXPECT_EQ(scanned[1].graph, red.graph);
  ASSERT_OK_AND_ASSIGN(const ScannedGraph found,
                       catalog_->FindGraph(cups.uid, "red"));
  EXPECT_EQ(found.graph, red.graph);
  ASSERT_OK_AND_ASSIGN(const std::vector<ScannedGraph> rest,
                       catalog_->ScanGraphs(cups.uid, "blue", 1));
  EXPECT_EQ(rest.size(), 1U);
}

TEST_P(CatalogPortTest, AnswersARepeatedPutWithTheFirstAnswer) {
  const CollectionRecord cups = SampleCollection("cups");
  ASSERT_THAT(catalog_->InsertCollection(cups, {}), IsOk());
  ShapePut put = SamplePut(cups, "red", 1);
  put.request = SampleRequest('1', "AddShape", "red");
  ASSERT_OK_AND_ASSIGN(const std::optional<ShapeWritten> before,
                       catalog_->FindPutShape(put.request));
  EXPECT_FALSE(before.has_value());
  ASSERT_OK_AND_ASSIGN(const ShapeWritten first, catalog_->PutShape(put));
  ASSERT_OK_AND_ASSIGN(const ShapeWritten second, catalog_->PutShape(put));
  EXPECT_FALSE(second.written);
  EXPECT_TRUE(SameRecord(second.record, first.record));
  EXPECT_EQ(second.collection_uid, cups.uid);
  ASSERT_OK_AND_ASSIGN(const std::optional<ShapeWritten> found,
                       catalog_->FindPutShape(put.request));
  ASSERT_TRUE(found.has_value());
  EXPECT_TRUE(SameRecord(found->record, first.record));
  // Also when the shape has gone since.
  ASSERT_THAT(catalog_->DeleteShape({"cups", "red", "", {}}), IsOk());
  ASSERT_OK_AND_ASSIGN(const ShapeWritten third, catalog_->PutShape(put));
  EXPECT_TRUE(SameRecord(third.record, first.record));
  EXPECT_EQ(ReasonOrOk(catalog_->GetShape("cups", "red")),
            ErrorReason::kShapeNotFound);
}

TEST_P(CatalogPortTest, RefusesARequestIdThatMeantSomethingElse) {
  const CollectionRecord cups = SampleCollection("cups");
  ASSERT_THAT(catalog_->InsertCollection(
                  cups, SampleRequest('1', "CreateCollection", "cups")),
              IsOk());
  ShapePut put = SamplePut(cups, "red", 1);
  put.request = SampleRequest('1', "AddShape", "cups");
  EXPECT_EQ(ReasonOrOk(catalog_->PutShape(put)), ErrorReason::kRequestIdReused);
  EXPECT_EQ(ReasonOrOk(catalog_->FindPutShape(put.request)),
            ErrorReason::kRequestIdReused);
  EXPECT_EQ(ReasonOrOk(catalog_->DeleteShape(
                {"cups", "red", "", SampleRequest('1', "DeleteShape", "x")})),
            ErrorReason::kRequestIdReused);
  put.request.principal = "somebody else";
  EXPECT_THAT(catalog_->PutShape(put), IsOk());
}

TEST_P(CatalogPortTest, RepeatsTheAnswersOfCreateAndDelete) {
  const CollectionRecord cups = SampleCollection("cups");
  const RequestStamp create = SampleRequest('1', "CreateCollection", "cups");
  ASSERT_THAT(catalog_->InsertCollection(cups, create), IsOk());
  ASSERT_OK_AND_ASSIGN(
      const CollectionRecord again,
      catalog_->InsertCollection(SampleCollection("cups"), create));
  EXPECT_EQ(again.uid, cups.uid);
  ASSERT_THAT(catalog_->PutShape(SamplePut(cups, "red", 1)), IsOk());
  const ShapeDelete removal{"cups", "red", "",
                            SampleRequest('2', "DeleteShape", "red")};
  ASSERT_OK_AND_ASSIGN(const ShapeDeleted first,
                       catalog_->DeleteShape(removal));
  ASSERT_OK_AND_ASSIGN(const ShapeDeleted second,
                       catalog_->DeleteShape(removal));
  EXPECT_EQ(second.generation, first.generation);
}

TEST_P(CatalogPortTest, RepeatsTheAnswersOfUpdates) {
  const CollectionRecord cups = SampleCollection("cups");
  ASSERT_THAT(catalog_->InsertCollection(cups, {}), IsOk());
  ASSERT_THAT(catalog_->PutShape(SamplePut(cups, "red", 1)), IsOk());
  ASSERT_OK_AND_ASSIGN(const ShapeRecord red,
                       catalog_->GetShape("cups", "red"));
  // With the etag of before, which is no more the stored one.
  const ShapePatch patch{.collection = "cups",
                         .id = "red",
                         .display_name = "the red one",
                         .source_uri = {},
                         .metadata = {},
                         .etag = ShapeEtag(red),
                         .update_time = red.update_time,
                         .request = SampleRequest('1', "UpdateShape", "red")};
  ASSERT_OK_AND_ASSIGN(const ShapeWritten first, catalog_->UpdateShape(patch));
  ASSERT_OK_AND_ASSIGN(const ShapeWritten second, catalog_->UpdateShape(patch));
  EXPECT_TRUE(SameRecord(second.record, first.record));
  EXPECT_EQ(second.collection_uid, cups.uid);

  ASSERT_OK_AND_ASSIGN(const CollectionRecord present,
                       catalog_->GetCollection("cups"));
  CollectionPatch name;
  name.id = "cups";
  name.display_name = "all cups";
  name.etag = CollectionEtag(present);
  name.request = SampleRequest('2', "UpdateCollection", "cups");
  ASSERT_OK_AND_ASSIGN(const CollectionRecord named,
                       catalog_->UpdateCollection(name));
  ASSERT_OK_AND_ASSIGN(const CollectionRecord again,
                       catalog_->UpdateCollection(name));
  EXPECT_EQ(again.revision, named.revision);
  EXPECT_EQ(again.display_name, "all cups");
}

TEST_P(CatalogPortTest, RepeatsTheAnswersOfDeletionsOfMany) {
  const CollectionRecord cups = SampleCollection("cups");
  ASSERT_THAT(catalog_->InsertCollection(cups, {}), IsOk());
  for (const char* id : {"blue", "red"}) {
    ASSERT_THAT(catalog_->PutShape(SamplePut(cups, id, 1)), IsOk());
  }
  const ShapesDelete both{
      "cups", {"blue", "red"}, SampleRequest('1', "DeleteShapes", "both")};
  ASSERT_OK_AND_ASSIGN(const ShapeDeleted first, catalog_->DeleteShapes(both));
  ASSERT_OK_AND_ASSIGN(const ShapeDeleted second, catalog_->DeleteShapes(both));
  EXPECT_EQ(second.generation, first.generation);
  EXPECT_EQ(second.collection_uid, cups.uid);

  const CollectionDelete all{"cups", false, "",
                             SampleRequest('2', "DeleteCollection", "cups")};
  ASSERT_THAT(catalog_->DeleteCollection(all), IsOk());
  ASSERT_OK_AND_ASSIGN(const CollectionDeleted gone,
                       catalog_->DeleteCollection(all));
  EXPECT_EQ(gone.uid, cups.uid);
  // Not the collection that has the id meanwhile.
  ASSERT_THAT(catalog_->InsertCollection(SampleCollection("cups"), {}), IsOk());
  EXPECT_THAT(catalog_->DeleteCollection(all), IsOk());
  EXPECT_THAT(catalog_->GetCollection("cups"), IsOk());
}

TEST_P(CatalogPortTest, DeletesAllShapesOfAListOrNone) {
  const CollectionRecord cups = SampleCollection("cups");
  ASSERT_THAT(catalog_->InsertCollection(cups, {}), IsOk());
  for (const char* id : {"blue", "green", "red"}) {
    ASSERT_THAT(catalog_->PutShape(SamplePut(cups, id, 1)), IsOk());
  }
  EXPECT_EQ(ReasonOrOk(catalog_->DeleteShapes({"cups", {"red", "none"}})),
            ErrorReason::kShapeNotFound);
  EXPECT_EQ(ReasonOrOk(catalog_->DeleteShapes({"none", {"red"}})),
            ErrorReason::kCollectionNotFound);
  EXPECT_THAT(catalog_->GetShape("cups", "red"), IsOk());
  ASSERT_OK_AND_ASSIGN(const ShapeDeleted two,
                       catalog_->DeleteShapes({"cups", {"red", "blue"}}));
  EXPECT_EQ(two.generation, 5);
  EXPECT_EQ(two.collection_uid, cups.uid);
  EXPECT_TRUE(two.unreferenced.empty());  // "green" has the same mesh
  ASSERT_OK_AND_ASSIGN(const ShapeDeleted last,
                       catalog_->DeleteShapes({"cups", {"green"}}));
  EXPECT_EQ(last.unreferenced.size(), 1U);
  ASSERT_OK_AND_ASSIGN(const CollectionRecord left,
                       catalog_->GetCollection("cups"));
  EXPECT_EQ(left.shape_count, 0);
  EXPECT_EQ(left.generation, 6);
}

TEST_P(CatalogPortTest, ForgetsARequestAfterItsTime) {
  const CollectionRecord cups = SampleCollection("cups");
  ASSERT_THAT(catalog_->InsertCollection(cups, {}), IsOk());
  ShapePut put = SamplePut(cups, "red", 1);
  put.request = SampleRequest('1', "AddShape", "red");
  put.request.expire_time = absl::UnixEpoch();
  ASSERT_THAT(catalog_->PutShape(put), IsOk());
  EXPECT_EQ(ReasonOrOk(catalog_->PutShape(put)), ErrorReason::kShapeExists);
}

TEST_P(CatalogPortTest, RefusesEverythingOnceItIsClosed) {
  const CollectionRecord cups = SampleCollection("cups");
  ASSERT_THAT(catalog_->InsertCollection(cups, {}), IsOk());
  ASSERT_THAT(catalog_->Close(), IsOk());
  ASSERT_THAT(catalog_->Close(), IsOk());
  EXPECT_EQ(ReasonOrOk(catalog_->GetCollection("cups")),
            ErrorReason::kDraining);
  EXPECT_EQ(ReasonOrOk(catalog_->PutShape(SamplePut(cups, "red", 1))),
            ErrorReason::kDraining);
}

}  // namespace
}  // namespace argmesh
