#include "core/synthesis/sample_collection.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/support/status_matchers.h"
#include "tests/unit/core/synthesis/closed_surface.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

SampleCollectionOptions SmallOptions() {
  return {.shapes_per_class = 1, .seed = 3, .shape = {.target_vertices = 1500}};
}

TEST(MakeSampleCollection, VisitsEveryClassOnceUnderItsPath) {
  std::vector<std::string> paths;
  std::set<std::string> classes;
  EXPECT_THAT(MakeSampleCollection(SmallOptions(),
                                   [&](const SampleItem& item) {
                                     paths.push_back(item.relative_path);
                                     classes.insert(item.class_name);
                                     return absl::OkStatus();
                                   }),
              IsOk());
  EXPECT_EQ(static_cast<int>(paths.size()), CountSampleItems(SmallOptions()));
  EXPECT_EQ(classes.size(), SampleClassNames().size());
  EXPECT_EQ(paths.front(), "airplane/airplane-00.off");
}

TEST(MakeSampleCollection, StopsAtTheVisitorsError) {
  int visits = 0;
  EXPECT_THAT(MakeSampleCollection(SmallOptions(),
                                   [&](const SampleItem&) {
                                     ++visits;
                                     return absl::AbortedError("enough");
                                   }),
              StatusIs(absl::StatusCode::kAborted, HasSubstr("enough")));
  EXPECT_EQ(visits, 1);
}

TEST(MakeSampleItem, GivesTheSharesOfConditionsTheirVariants) {
  SampleCollectionOptions options = SmallOptions();
  options.shapes_per_class = 8;
  options.noisy_share = 0.25;
  options.cut_share = 0.25;
  options.moved_share = 0.125;
  std::map<SampleCondition, int> counts;
  for (int variant = 0; variant < 8; ++variant) {
    const int chair = 3 * options.shapes_per_class + variant;
    ASSERT_OK_AND_ASSIGN(const SampleItem item, MakeSampleItem(options, chair));
    EXPECT_EQ(item.class_name, "chair");
    ++counts[item.condition];
    const bool closed = CountSurface(item.mesh).unpaired_halfedges == 0;
    EXPECT_EQ(closed, item.condition != SampleCondition::kCut) << variant;
  }
  EXPECT_EQ(counts[SampleCondition::kClean], 3);
  EXPECT_EQ(counts[SampleCondition::kNoisy], 2);
  EXPECT_EQ(counts[SampleCondition::kCut], 2);
  EXPECT_EQ(counts[SampleCondition::kMoved], 1);
}

TEST(MakeSampleItem, DependsOnTheSeedAlone) {
  SampleCollectionOptions options = SmallOptions();
  ASSERT_OK_AND_ASSIGN(const SampleItem a, MakeSampleItem(options, 2));
  ASSERT_OK_AND_ASSIGN(const SampleItem b, MakeSampleItem(options, 2));
  EXPECT_EQ(a.mesh.V, b.mesh.V);
  options.seed = 4;
  ASSERT_OK_AND_ASSIGN(const SampleItem c, MakeSampleItem(options, 2));
  EXPECT_FALSE(a.mesh.V.rows() == c.mesh.V.rows() && a.mesh.V == c.mesh.V);
}

TEST(MakeSampleItem, RefusesOptionsOutsideTheirRange) {
  const struct {
    SampleCollectionOptions options;
    int item;
    const char* message;
  } cases[] = {
      {{.shapes_per_class = 0}, 0, "shapes_per_class 0"},
      {{.noisy_share = 1.5}, 0, "share 1.5"},
      {{.noisy_share = 0.6, .cut_share = 0.6}, 0, "sum to 1.2"},
      {{.noise = 0.2}, 0, "noise 0.2"},
      {{.shape = {.target_vertices = 5}}, 0, "target_vertices 5"},
      {{}, -1, "item -1"},
      {{}, 100'000, "item 100000"},
  };
  for (const auto& c : cases) {
    EXPECT_THAT(
        MakeSampleItem(c.options, c.item),
        StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr(c.message)));
  }
}

}  // namespace
}  // namespace argmesh
