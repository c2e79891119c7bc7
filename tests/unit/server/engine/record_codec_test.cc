#include "server/engine/record_codec.h"

#include <string>

#include "tests/support/catalog_samples.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

ShapeRecord FullRecord() {
  ShapeRecord record = SamplePut(SampleCollection("cups"), "red", 1).record;
  record.error = "none";
  record.generation = 12;
  record.report.euler_characteristic = -2;
  record.report.bounding_box_min[1] = -0.25;
  return record;
}

TEST(RecordCodec, GivesBackEveryFieldOfAShape) {
  const ShapeRecord record = FullRecord();
  ASSERT_OK_AND_ASSIGN(const ShapeRecord back,
                       ParseShapeRecord(SerializeShapeRecord(record)));
  EXPECT_EQ(back.collection, record.collection);
  EXPECT_EQ(back.id, record.id);
  EXPECT_EQ(back.uid, record.uid);
  EXPECT_EQ(back.display_name, record.display_name);
  EXPECT_EQ(back.source_uri, record.source_uri);
  EXPECT_EQ(back.metadata, record.metadata);
  EXPECT_EQ(back.state, record.state);
  EXPECT_EQ(back.error, record.error);
  EXPECT_EQ(back.sha256, record.sha256);
  EXPECT_EQ(back.size_bytes, record.size_bytes);
  EXPECT_EQ(back.format, record.format);
  EXPECT_EQ(back.mesh_stored, record.mesh_stored);
  EXPECT_EQ(back.graph, record.graph);
  EXPECT_EQ(back.generation, record.generation);
  EXPECT_EQ(back.create_time, record.create_time);
  EXPECT_EQ(back.update_time, record.update_time);
  EXPECT_EQ(back.report.euler_characteristic, -2);
  EXPECT_EQ(back.report.bounding_box_min[1], -0.25);
  EXPECT_EQ(back.report.faces, record.report.faces);
  EXPECT_EQ(back.report.area, record.report.area);
  EXPECT_TRUE(back.report.smoothed);
}

TEST(RecordCodec, GivesBackCollectionsAndRememberedAnswers) {
  CollectionRecord cups = SampleCollection("cups");
  cups.settings.decomposition = DecompositionKind::kVoronoi;
  cups.settings.store_meshes = false;
  cups.metadata_keys = {{"class", MetadataType::kString},
                        {"mass", MetadataType::kNumber}};
  cups.generation = 7;
  cups.revision = 3;
  ASSERT_OK_AND_ASSIGN(const CollectionRecord back,
                       ParseCollectionRecord(SerializeCollectionRecord(cups)));
  EXPECT_EQ(back, cups);
  ASSERT_OK_AND_ASSIGN(
      const CollectionSettings settings,
      ParseCollectionSettings(SerializeCollectionSettings(cups.settings)));
  EXPECT_EQ(settings, cups.settings);
  ASSERT_OK_AND_ASSIGN(
      const ShapeDeleted deleted,
      ParseShapeDeleted(SerializeShapeDeleted({"uid", 12, {}})));
  EXPECT_EQ(deleted.collection_uid, "uid");
  EXPECT_EQ(deleted.generation, 12);
  ASSERT_OK_AND_ASSIGN(const ShapeWritten written,
                       ParseShapeWritten(SerializeShapeWritten(
                           {FullRecord(), "uid", true, {}})));
  EXPECT_EQ(written.collection_uid, "uid");
  EXPECT_EQ(written.record.generation, 12);
}

TEST(RecordCodec, RefusesBytesThatAreCutOrTooLong) {
  const std::string bytes = SerializeShapeRecord(FullRecord());
  for (size_t cut = 0; cut < bytes.size(); ++cut) {
    EXPECT_EQ(ParseShapeRecord(bytes.substr(0, cut)).status().code(),
              absl::StatusCode::kDataLoss)
        << cut;
  }
  EXPECT_FALSE(ParseShapeRecord(bytes + "x").ok());
}

TEST(RecordCodec, RefusesCountsBeyondTheBytesAndOtherVersions) {
  std::string bytes = SerializeShapeRecord(FullRecord());
  for (size_t at = 0; at + 4 <= bytes.size(); ++at) {
    std::string hostile = bytes;
    hostile.replace(at, 4, 4, '\xFF');
    (void)ParseShapeRecord(hostile);  // must neither crash nor grow
  }
  bytes[0] = 2;
  EXPECT_THAT(
      ParseShapeRecord(bytes),
      StatusIs(absl::StatusCode::kDataLoss, ::testing::HasSubstr("version 2")));
}

}  // namespace
}  // namespace argmesh
