#include "core/signature/rerank.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/random.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

// Similarities of points on a line.
Eigen::MatrixXd OnALine(const std::vector<double>& places) {
  const auto n = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXd similarity(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      similarity(i, j) = std::exp(-std::abs(places[static_cast<size_t>(i)] -
                                            places[static_cast<size_t>(j)]));
    }
  }
  return similarity;
}

TEST(RerankShortList, PutsTheQuerysNeighborhoodFirst) {
  // The query ends a chain of five; a pair of strangers is nearer to it than
  // the far end of the chain.
  const Eigen::MatrixXd similarity =
      OnALine({0.0, 0.1, 0.2, 0.3, 0.4, -0.35, -0.36, -0.37, -0.38});
  RerankOptions options;
  options.neighbors = 4;
  options.expansion = 2;
  ASSERT_GT(similarity(0, 5), similarity(0, 4));
  ASSERT_OK_AND_ASSIGN(const Eigen::VectorXd scores,
                       RerankShortList(similarity, options));
  ASSERT_EQ(scores.size(), 8);
  EXPECT_GT(scores[3], scores[4]);
}

TEST(RerankShortList, KeepsThePlainOrderWhenAskedTo) {
  const Eigen::MatrixXd similarity = OnALine({0.0, 0.3, -0.1, 0.5, -0.2});
  RerankOptions options;
  options.original_share = 1;
  ASSERT_OK_AND_ASSIGN(const Eigen::VectorXd scores,
                       RerankShortList(similarity, options));
  EXPECT_GT(scores[1], scores[3]);
  EXPECT_GT(scores[3], scores[0]);
  EXPECT_GT(scores[0], scores[2]);
}

TEST(RerankShortList, StaysWithinZeroAndOne) {
  Random random(1);
  std::vector<double> places;
  for (int i = 0; i < 60; ++i) places.push_back(random.Uniform(0, 3));
  ASSERT_OK_AND_ASSIGN(const Eigen::VectorXd scores,
                       RerankShortList(OnALine(places)));
  EXPECT_GE(scores.minCoeff(), 0.0);
  EXPECT_LE(scores.maxCoeff(), 1.0);
}

TEST(RerankShortList, TakesListsOfNothingAndOfEquals) {
  ASSERT_OK_AND_ASSIGN(const Eigen::VectorXd none,
                       RerankShortList(Eigen::MatrixXd::Ones(1, 1)));
  EXPECT_EQ(none.size(), 0);
  ASSERT_OK_AND_ASSIGN(const Eigen::VectorXd equal,
                       RerankShortList(Eigen::MatrixXd::Ones(5, 5)));
  EXPECT_TRUE(equal.isConstant(equal[0]));
}

TEST(RerankShortList, NamesWhatIsWrong) {
  Eigen::MatrixXd similarity = OnALine({0, 1, 2});
  EXPECT_THAT(RerankShortList(similarity.topRows(2)),
              StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("2 x 3")));
  RerankOptions options;
  options.neighbors = 0;
  EXPECT_THAT(
      RerankShortList(similarity, options),
      StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("neighbors 0")));
  options = {};
  options.original_share = 1.5;
  EXPECT_THAT(RerankShortList(similarity, options),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       HasSubstr("original_share 1.5")));
  similarity(1, 2) = 0.9;
  EXPECT_THAT(RerankShortList(similarity),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       HasSubstr("shapes 2 and 1")));
  similarity(1, 2) = similarity(2, 1) = std::nan("");
  EXPECT_THAT(RerankShortList(similarity),
              StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("nan")));
}

}  // namespace
}  // namespace argmesh
