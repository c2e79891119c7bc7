#include "core/matching/attribute_groups.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/matching/frozen_scales.h"

namespace argmesh {
namespace {

TEST(ExtractAttributes, PutsEveryAttributeIntoItsGroup) {
  ArgNode node;
  node.tuple = {1, 2, 3, 4, 5, 6, 7, -2};
  node.histograms.shape_diameter = {0.25F, 0.5F, 0.25F};
  node.histograms.shape_index[8] = 1;
  node.histograms.relative_diameter[9] = 1;
  node.wave_kernel[0] = -1;
  node.wave_kernel[15] = -3;
  const AttributeVector x = ExtractAttributes(node);
  EXPECT_EQ(x[GroupOffset(kTupleGroup)], 1);
  EXPECT_EQ(x[GroupOffset(kTupleGroup) + 6], 7);
  EXPECT_EQ(x[GroupOffset(kAreaGroup)], -2);
  EXPECT_EQ(x[GroupOffset(kShapeDiameterGroup)], 0.25F);
  EXPECT_EQ(x[GroupOffset(kShapeDiameterGroup) + 1], 0.75F);
  EXPECT_EQ(x[GroupOffset(kShapeDiameterGroup) + 9], 1);
  EXPECT_EQ(x[GroupOffset(kShapeIndexGroup) + 7], 0);
  EXPECT_EQ(x[GroupOffset(kShapeIndexGroup) + 8], 1);
  EXPECT_EQ(x[GroupOffset(kWaveKernelGroup)], -1);
  EXPECT_EQ(x[GroupOffset(kWaveKernelGroup) + 15], -3);
  EXPECT_EQ(x[kAttributeDims - 1], 1);
}

TEST(ExtractAttributes, TreatsTinyAreasAlike) {
  ArgNode node;
  node.tuple.log2_relative_area = -30;
  EXPECT_NEAR(ExtractAttributes(node)[GroupOffset(kAreaGroup)], -13.2877, 1e-4);
}

TEST(DefaultFrozenScales, ArePositiveAndOneForHistograms) {
  const FrozenScales& scales = DefaultFrozenScales();
  for (size_t g = 0; g < kNumAttributeGroups; ++g) {
    EXPECT_GT(scales.component[g], 0) << kGroups[g].name;
    EXPECT_GT(scales.uniform[g], 0) << kGroups[g].name;
    EXPECT_GT(scales.partial[g], 0) << kGroups[g].name;
    for (size_t k = 0; k < kGroups[g].dims; ++k) {
      const float deviation = scales.deviation[GroupOffset(g) + k];
      EXPECT_GT(deviation, 0) << kGroups[g].name << " " << k;
      if (kGroups[g].histogram) {
        EXPECT_EQ(deviation, 1) << kGroups[g].name << " " << k;
      }
    }
  }
}

}  // namespace
}  // namespace argmesh
