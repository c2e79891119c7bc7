#include "server/engine/collection_index.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "core/base/random.h"
#include "tests/support/catalog_samples.h"
#include "tests/support/random_graph.h"

namespace argmesh {
namespace {

IndexedShape Shape(const std::string& id, int64_t generation) {
  static const ShapeGraph graph = MakeRandomGraph(1);
  ShapeRecord record;
  record.id = id;
  record.generation = generation;
  return {
      std::make_shared<const GalleryEntry>(GalleryEntry{
          record, MatchableGraph(graph), PackedSignature(SampleSignature(1))}),
      {}};
}

std::map<std::string, int64_t> Contents(const GallerySnapshot& snapshot) {
  std::map<std::string, int64_t> contents;
  for (const auto& block : snapshot.blocks) {
    EXPECT_LE(block->size(), kGalleryBlockSize);
    for (const GalleryEntryPtr& entry : *block) {
      if (entry == nullptr) continue;
      EXPECT_TRUE(
          contents.emplace(entry->record.id, entry->record.generation).second)
          << entry->record.id << " twice";
    }
  }
  EXPECT_EQ(static_cast<int64_t>(contents.size()), snapshot.size);
  EXPECT_EQ(snapshot.windows.size(), snapshot.size);
  return contents;
}

TEST(CollectionIndex, ShowsNothingBeforeItIsPublished) {
  CollectionIndex index(SampleCollection("cups"));
  index.Put(Shape("a", 1));
  EXPECT_EQ(index.snapshot(), nullptr);
  index.Publish(1);
  EXPECT_EQ(index.snapshot()->generation, 1);
  EXPECT_EQ(Contents(*index.snapshot()).size(), 1U);
}

TEST(CollectionIndex, LeavesASnapshotAsItWas) {
  CollectionIndex index(SampleCollection("cups"));
  index.Put(Shape("a", 1));
  index.Put(Shape("b", 2));
  index.Publish(2);
  const GallerySnapshotPtr before = index.snapshot();
  index.Put(Shape("a", 3));
  index.Remove("b");
  index.Put(Shape("c", 5));
  index.Publish(5);
  EXPECT_EQ(Contents(*before),
            (std::map<std::string, int64_t>{{"a", 1}, {"b", 2}}));
  EXPECT_EQ(Contents(*index.snapshot()),
            (std::map<std::string, int64_t>{{"a", 3}, {"c", 5}}));
}

TEST(CollectionIndex, KeepsSlotsAndUsesThemAgain) {
  CollectionIndex index(SampleCollection("cups"));
  for (const char* id : {"a", "b", "c"}) index.Put(Shape(id, 1));
  index.Remove("a");
  index.Put(Shape("b", 2));
  index.Put(Shape("d", 3));
  index.Publish(3);
  const GallerySnapshotPtr snapshot = index.snapshot();
  ASSERT_EQ(snapshot->blocks.at(0)->size(), 3U);
  EXPECT_EQ(snapshot->entry(0)->record.id, "d");
  EXPECT_EQ(snapshot->entry(1)->record.id, "b");
  EXPECT_EQ(snapshot->entry(2)->record.id, "c");
}

TEST(CollectionIndex, CountsShapesThatCannotBeMatched) {
  CollectionIndex index(SampleCollection("cups"));
  index.Put(Shape("a", 1));
  index.PutUnusable("a", CollectionIndex::Unusable::kDamaged);
  index.PutUnusable("b", CollectionIndex::Unusable::kOutdated);
  index.Publish(2);
  EXPECT_EQ(index.snapshot()->size, 0);
  EXPECT_EQ(index.snapshot()->damaged_shapes, 1);
  EXPECT_EQ(index.snapshot()->outdated_shapes, 1);
  index.Put(Shape("a", 3));
  index.Remove("b");
  index.Publish(3);
  EXPECT_EQ(index.snapshot()->size, 1);
  EXPECT_EQ(index.snapshot()->damaged_shapes, 0);
  EXPECT_EQ(index.snapshot()->outdated_shapes, 0);
}

TEST(CollectionIndex, AgreesWithAMapUnderRandomChanges) {
  for (const uint64_t seed : {1U, 2U, 3U}) {
    SCOPED_TRACE(seed);
    Random random(seed);
    CollectionIndex index(SampleCollection("cups"));
    std::map<std::string, int64_t> model;
    for (int64_t generation = 1; generation <= 3000; ++generation) {
      const std::string id = "s" + std::to_string(random.Below(400));
      if (random.Below(3) == 0) {
        index.Remove(id);
        model.erase(id);
      } else {
        index.Put(Shape(id, generation));
        model[id] = generation;
      }
      if (generation % 500 == 0) {
        index.Publish(generation);
        EXPECT_EQ(Contents(*index.snapshot()), model);
      }
    }
  }
}

}  // namespace
}  // namespace argmesh
