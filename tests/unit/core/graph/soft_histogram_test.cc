#include "core/graph/soft_histogram.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace argmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::FloatNear;

TEST(SoftHistogram, SharesASampleBetweenTheTwoNearestBins) {
  SoftHistogram<4> histogram;
  histogram.Add(0.25, 1);  // the border of bins 0 and 1
  EXPECT_THAT(histogram.Normalized(), ElementsAre(0.5F, 0.5F, 0, 0));
}

TEST(SoftHistogram, PutsTheMiddleOfABinIntoItAlone) {
  SoftHistogram<4> histogram;
  histogram.Add(0.625, 2);
  EXPECT_THAT(histogram.Normalized(), ElementsAre(0, 0, 1, 0));
}

TEST(SoftHistogram, KeepsWhatLiesBeyondTheRangeInTheLastBins) {
  SoftHistogram<4> histogram;
  histogram.Add(-3, 1);
  histogram.Add(0, 1);
  histogram.Add(1, 1);
  histogram.Add(7, 1);
  EXPECT_THAT(histogram.Normalized(), ElementsAre(0.5F, 0, 0, 0.5F));
}

TEST(SoftHistogram, WeighsSamples) {
  SoftHistogram<2> histogram;
  histogram.Add(0.25, 3);
  histogram.Add(0.75, 1);
  EXPECT_THAT(histogram.Normalized(),
              ElementsAre(FloatNear(0.75F, 1e-6F), FloatNear(0.25F, 1e-6F)));
}

TEST(SoftHistogram, IsFlatWhenEmpty) {
  EXPECT_THAT(SoftHistogram<4>().Normalized(),
              ElementsAre(0.25F, 0.25F, 0.25F, 0.25F));
}

}  // namespace
}  // namespace argmesh
