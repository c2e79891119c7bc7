// Filtered lists of every catalog against a plain look at all shapes.
#include "server/storage/filter_condition.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "server/engine/error_reason.h"
#include "server/engine/uid.h"
#include "tests/support/catalog_samples.h"
#include "tests/support/random_filter.h"
#include "tests/support/status_matchers.h"
#include "tests/unit/server/storage/catalog_bench.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

// ARGMESH_FILTER_SEED, 1 when not set.
uint64_t Seed() {
  const char* given = std::getenv("ARGMESH_FILTER_SEED");
  return given == nullptr ? 1 : std::strtoull(given, nullptr, 10);
}

CollectionPatch Declaring(std::vector<MetadataKey> keys) {
  CollectionPatch patch;
  patch.id = "cups";
  patch.metadata_keys = std::move(keys);
  return patch;
}

// The ids that pages of random sizes have, one after the other.
std::vector<std::string> ListAll(const Catalog& catalog, Random& random,
                                 const std::string& filter) {
  std::vector<std::string> ids;
  ShapeSlice slice;
  slice.filter = filter;
  while (true) {
    slice.limit = static_cast<int>(1 + random.Below(20));
    const auto page = catalog.ListShapes("cups", slice);
    EXPECT_TRUE(page.ok()) << filter << ": " << page.status();
    if (!page.ok() || page->empty()) return ids;
    for (const ShapeRecord& record : *page) ids.push_back(record.id);
    slice.after_id = ids.back();
  }
}

std::vector<std::string> LookThroughAll(
    const std::map<std::string, Metadata>& shapes, const RandomFilter& filter) {
  std::vector<std::string> ids;
  for (const auto& [id, metadata] : shapes) {
    if (filter.holds(metadata)) ids.push_back(id);
  }
  return ids;
}

TEST_P(CatalogPortTest, ListsWhatAPlainScanFindsForRandomFilters) {
  constexpr int kShapes = 60;
  constexpr int kRounds = 400;
  const uint64_t seed = Seed();
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  Random random(seed);
  const std::vector<MetadataKey> keys = SampleMetadataKeys();
  CollectionRecord cups = SampleCollection("cups");
  CollectionRecord others = SampleCollection("others");
  // Declared before some shapes, after others, and one of them late.
  cups.metadata_keys.assign(keys.begin(), keys.begin() + 2);
  others.metadata_keys = keys;
  ASSERT_THAT(catalog_->InsertCollection(cups, {}), IsOk());
  ASSERT_THAT(catalog_->InsertCollection(others, {}), IsOk());
  std::map<std::string, Metadata> shapes;
  const auto write = [&](int i) {
    ShapePut put = SamplePut(cups, "s" + std::to_string(i), 1);
    put.if_exists = IfExists::kReplace;
    put.record.metadata = MakeRandomMetadata(random, keys);
    shapes[put.record.id] = put.record.metadata;
    ASSERT_THAT(catalog_->PutShape(put), IsOk());
    put.record.collection = "others";  // must never be found
    put.record.uid = MakeUid();
    put.collection_uid = others.uid;
    ASSERT_THAT(catalog_->PutShape(put), IsOk());
  };
  for (int i = 0; i < kShapes; ++i) write(i);
  ASSERT_THAT(catalog_->UpdateCollection(Declaring(keys)), IsOk());
  for (int round = 0; round < kRounds; ++round) {
    if (round % 10 == 0) write(static_cast<int>(random.Below(kShapes)));
    const RandomFilter filter = MakeRandomFilter(random, keys);
    ASSERT_EQ(ListAll(*catalog_, random, filter.text),
              LookThroughAll(shapes, filter))
        << "seed " << seed << ": " << filter.text;
  }
}

TEST_P(CatalogPortTest, FollowsUpdatesDeletesAndDeclarations) {
  CollectionRecord cups = SampleCollection("cups");
  cups.metadata_keys = {{"mass", MetadataType::kNumber}};
  ASSERT_THAT(catalog_->InsertCollection(cups, {}), IsOk());
  for (const char* id : {"a", "b", "c"}) {
    ShapePut put = SamplePut(cups, id, 1);
    put.record.metadata = {{"mass", "1"}};
    ASSERT_THAT(catalog_->PutShape(put), IsOk());
  }
  const auto listed = [&] {
    Random random(1);
    return ListAll(*catalog_, random, "mass = 1");
  };
  EXPECT_THAT(listed(), ElementsAre("a", "b", "c"));
  ShapePatch patch;
  patch.collection = "cups";
  patch.id = "b";
  patch.metadata = Metadata{{"mass", "2"}};
  ASSERT_THAT(catalog_->UpdateShape(patch), IsOk());
  ShapeDelete removal;
  removal.collection = "cups";
  removal.id = "c";
  ASSERT_THAT(catalog_->DeleteShape(removal), IsOk());
  EXPECT_THAT(listed(), ElementsAre("a"));
  ASSERT_THAT(catalog_->UpdateCollection(Declaring({})), IsOk());
  EXPECT_EQ(
      ReasonOf(catalog_->ListShapes("cups", {"", 10, "mass = 1"}).status()),
      ErrorReason::kFilterKeyUndeclared);
}

TEST(FilterCondition, HasNothingOfTheFilterInItsText) {
  const std::vector<MetadataKey> keys = {{"k'--", MetadataType::kString}};
  ASSERT_OK_AND_ASSIGN(
      const MetadataFilter filter,
      MetadataFilter::Parse(
          R"(NOT ("k'--" = "v'; DROP TABLE shape; --" OR "k'--":*))", keys));
  const FilterCondition condition(filter);
  EXPECT_THAT(condition.sql(), Not(HasSubstr("k'")));
  EXPECT_THAT(condition.sql(), Not(HasSubstr("DROP")));
  EXPECT_EQ(std::count(condition.sql().begin(), condition.sql().end(), '?'), 5);
  EXPECT_EQ(FilterCondition(MetadataFilter()).sql(), "1");
}

}  // namespace
}  // namespace argmesh
