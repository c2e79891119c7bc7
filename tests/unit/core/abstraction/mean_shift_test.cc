#include "core/abstraction/mean_shift.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

// `count` points around each center, masses summing to 1.
struct Clusters {
  Eigen::MatrixXf points;
  Eigen::VectorXf masses;
};

Clusters MakeClusters(const Eigen::MatrixXf& centers, int count, float spread,
                      uint64_t seed) {
  Random random(seed);
  Clusters clusters;
  clusters.points.resize(centers.rows(), centers.cols() * count);
  for (Eigen::Index c = 0; c < centers.cols(); ++c) {
    for (int i = 0; i < count; ++i) {
      for (Eigen::Index d = 0; d < centers.rows(); ++d) {
        clusters.points(d, c * count + i) =
            centers(d, c) + spread * static_cast<float>(random.Normal());
      }
    }
  }
  clusters.masses = Eigen::VectorXf::Constant(
      clusters.points.cols(),
      1.0F / static_cast<float>(clusters.points.cols()));
  return clusters;
}

TEST(RunMeanShift, FindsOneModePerSeparatedCluster) {
  Eigen::MatrixXf centers(2, 3);
  centers << 0, 1, 0, 0, 0, 1;
  const Clusters clusters = MakeClusters(centers, 50, 0.02F, 11);
  MeanShiftOptions options;
  options.min_window = 0.1;
  options.max_window = 0.1;
  ASSERT_OK_AND_ASSIGN(
      const MeanShiftResult result,
      RunMeanShift(clusters.points, clusters.masses, options, {}));
  ASSERT_EQ(result.modes.size(), 3U);
  for (int c = 0; c < 3; ++c) {
    for (int i = 1; i < 50; ++i) {
      EXPECT_EQ(result.mode_of_point[static_cast<size_t>(c * 50 + i)],
                result.mode_of_point[static_cast<size_t>(c * 50)]);
    }
  }
}

TEST(RunMeanShift, FusesNearbyModesAsTheWindowGrowsAndKeepsTheirWindow) {
  Eigen::MatrixXf centers(1, 3);
  centers << 0, 0.5F, 10;
  const Clusters clusters = MakeClusters(centers, 40, 0.02F, 5);
  MeanShiftOptions options;
  options.min_window = 0.1;
  options.max_window = 1.0;
  ASSERT_OK_AND_ASSIGN(
      const MeanShiftResult result,
      RunMeanShift(clusters.points, clusters.masses, options, {}));
  ASSERT_EQ(result.modes.size(), 3U);
  int survivors = 0;
  float largest = 0;
  float smallest = 10;
  for (size_t m = 0; m < 3; ++m) {
    survivors += result.survivor_of_mode[m] == static_cast<int32_t>(m) ? 1 : 0;
    largest = std::max(largest, result.modes[m].window);
    smallest = std::min(smallest, result.modes[m].window);
  }
  EXPECT_EQ(survivors, 2);
  EXPECT_GT(largest, 0.8F);
  EXPECT_LT(smallest, 0.5F);
}

TEST(RunMeanShift, RepeatsToTheBit) {
  const Clusters clusters =
      MakeClusters(Eigen::MatrixXf::Random(5, 4), 60, 0.2F, 3);
  ASSERT_OK_AND_ASSIGN(const MeanShiftResult a,
                       RunMeanShift(clusters.points, clusters.masses, {}, {}));
  ASSERT_OK_AND_ASSIGN(const MeanShiftResult b,
                       RunMeanShift(clusters.points, clusters.masses, {}, {}));
  EXPECT_EQ(a.mode_of_point, b.mode_of_point);
  EXPECT_EQ(a.survivor_of_mode, b.survivor_of_mode);
}

TEST(RunMeanShift, StopsWhenCancelled) {
  std::stop_source source;
  source.request_stop();
  const Clusters clusters =
      MakeClusters(Eigen::MatrixXf::Zero(2, 1), 20, 0.2F, 3);
  EXPECT_THAT(
      RunMeanShift(clusters.points, clusters.masses, {},
                   StopToken(source.get_token(), absl::InfiniteFuture())),
      StatusIs(absl::StatusCode::kCancelled, testing::_));
}

}  // namespace
}  // namespace argmesh
