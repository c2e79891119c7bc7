#include "core/evaluation/class_matrix.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(ComputeClassMatrix, EqualsTheCaseWorkedByHand) {
  const std::vector<std::string> classes = {"cup", "ant", "cup", "ant"};
  Eigen::MatrixXd scores(4, 4);
  scores << 1, 0.2, 0.8, 0.4,  //
      0.2, 1, 0.6, 0.3,        //
      0.8, 0.6, 1, 0.0,        //
      0.4, 0.3, 0.0, 1;
  ASSERT_OK_AND_ASSIGN(const ClassMatrix matrix,
                       ComputeClassMatrix(scores, classes));
  EXPECT_THAT(matrix.names, ElementsAre("ant", "cup"));
  // The ones of items with themselves do not count.
  EXPECT_DOUBLE_EQ(matrix.mean(0, 0), 0.3);
  EXPECT_DOUBLE_EQ(matrix.mean(1, 1), 0.8);
  EXPECT_DOUBLE_EQ(matrix.mean(0, 1), (0.2 + 0.6 + 0.4 + 0.0) / 4);
  EXPECT_NEAR(matrix.margins[0], 0, 1e-12);
  EXPECT_DOUBLE_EQ(matrix.margins[1], 0.5);
  EXPECT_THAT(matrix.rivals, ElementsAre(1, 0));
}

TEST(ComputeClassMatrix, HasNoScoreOfALonelyItemWithItself) {
  const std::vector<std::string> classes = {"a", "b"};
  ASSERT_OK_AND_ASSIGN(
      const ClassMatrix matrix,
      ComputeClassMatrix(Eigen::MatrixXd::Ones(2, 2), classes));
  EXPECT_TRUE(std::isnan(matrix.mean(0, 0)));
  EXPECT_TRUE(std::isnan(matrix.margins[0]));
  EXPECT_EQ(matrix.mean(0, 1), 1);
}

TEST(ComputeClassMatrix, HasNoRivalOfTheOnlyClass) {
  const std::vector<std::string> classes = {"a", "a"};
  ASSERT_OK_AND_ASSIGN(
      const ClassMatrix matrix,
      ComputeClassMatrix(Eigen::MatrixXd::Ones(2, 2), classes));
  EXPECT_THAT(matrix.rivals, ElementsAre(-1));
  EXPECT_EQ(matrix.mean(0, 0), 1);
}

TEST(ComputeClassMatrix, RefusesScoresThatDoNotFit) {
  const std::vector<std::string> classes = {"a"};
  EXPECT_THAT(ComputeClassMatrix(Eigen::MatrixXd::Ones(2, 2), classes),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       HasSubstr("2 x 2 scores of 1 items")));
}

}  // namespace
}  // namespace argmesh
