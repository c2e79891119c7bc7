#include "core/evaluation/retrieval_metrics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;

TEST(EvaluateRanking, IsAllOnesForThePerfectRanking) {
  std::vector<uint8_t> relevant(64, 0);
  for (size_t i = 0; i < 32; ++i) relevant[i] = 1;
  const RetrievalMetrics metrics = EvaluateRanking(relevant, 32);
  EXPECT_EQ(metrics.nearest_neighbor, 1);
  EXPECT_EQ(metrics.first_tier, 1);
  EXPECT_EQ(metrics.second_tier, 1);
  EXPECT_EQ(metrics.e_measure, 1);
  EXPECT_DOUBLE_EQ(metrics.dcg, 1);
  EXPECT_DOUBLE_EQ(metrics.average_precision, 1);
}

TEST(EvaluateRanking, EqualsTheCaseWorkedByHand) {
  // 3 relevant items, at ranks 1, 3 and 6 of 7.
  const std::vector<uint8_t> relevant = {1, 0, 1, 0, 0, 1, 0};
  const RetrievalMetrics metrics = EvaluateRanking(relevant, 3);
  EXPECT_EQ(metrics.nearest_neighbor, 1);
  EXPECT_DOUBLE_EQ(metrics.first_tier, 2.0 / 3);
  EXPECT_DOUBLE_EQ(metrics.second_tier, 1);
  // Precision 3/32, recall 1: 2 * 3/32 / (35/32) = 6/35.
  EXPECT_DOUBLE_EQ(metrics.e_measure, 6.0 / 35);
  const double perfect = 1 + 1 + 1 / std::log2(3);
  EXPECT_DOUBLE_EQ(metrics.dcg,
                   (1 + 1 / std::log2(3) + 1 / std::log2(6)) / perfect);
  EXPECT_DOUBLE_EQ(metrics.average_precision, (1.0 + 2.0 / 3 + 3.0 / 6) / 3);
}

TEST(EvaluateRanking, CountsRelevantItemsThatWereNotRetrieved) {
  const std::vector<uint8_t> relevant = {0, 1};
  const RetrievalMetrics metrics = EvaluateRanking(relevant, 4);
  EXPECT_EQ(metrics.nearest_neighbor, 0);
  EXPECT_DOUBLE_EQ(metrics.first_tier, 0.25);
  EXPECT_DOUBLE_EQ(metrics.second_tier, 0.25);
  EXPECT_DOUBLE_EQ(metrics.dcg, 1 / (2 + 1 / std::log2(3) + 1 / std::log2(4)));
  EXPECT_DOUBLE_EQ(metrics.average_precision, 0.5 / 4);
  EXPECT_DOUBLE_EQ(EvaluateRanking({}, 2).e_measure, 0);
}

TEST(EvaluatePrecisionRecall, TakesTheBestPrecisionAtThatRecallOrAbove) {
  // Precision 1/2 at recall 1/2, 2/3 at recall 1.
  const std::vector<uint8_t> relevant = {0, 1, 1};
  EXPECT_THAT(EvaluatePrecisionRecall(relevant, 2), Each(2.0 / 3));
  // Precision 1 up to recall 1/2, then 2/4.
  const std::vector<uint8_t> falling = {1, 0, 0, 1};
  const PrecisionRecall curve = EvaluatePrecisionRecall(falling, 2);
  EXPECT_EQ(curve[9], 1);
  EXPECT_EQ(curve[10], 0.5);
  EXPECT_EQ(curve[19], 0.5);
  // What is never recalled has no precision.
  EXPECT_EQ(EvaluatePrecisionRecall(falling, 4)[19], 0);
}

std::vector<std::string> FiveItems() { return {"b", "a", "b", "a", "c"}; }

// Item 0 likes 2, item 1 likes 2 more than its mate 3, and so on.
Eigen::MatrixXd FiveScores() {
  Eigen::MatrixXd scores(5, 5);
  scores << 9, 1, 5, 2, 0,  //
      1, 0, 5, 4, 0,        // its own score, 0, must not matter
      5, 5, 9, 5, 5,        // ties: by index 0, 1, 3, 4
      0, 9, 0, 9, 8,        //
      1, 1, 1, 1, 1;
  return scores;
}

TEST(EvaluateScores, LeavesTheQueryOutAndBreaksTiesByIndex) {
  const std::vector<std::string> classes = FiveItems();
  ASSERT_OK_AND_ASSIGN(const RetrievalEvaluation evaluation,
                       EvaluateScores(FiveScores(), classes));
  ASSERT_EQ(evaluation.queries.size(), 4u);  // nothing is relevant to item 4
  EXPECT_EQ(evaluation.queries[0].metrics.nearest_neighbor, 1);
  EXPECT_EQ(evaluation.queries[1].metrics.nearest_neighbor, 0);
  EXPECT_EQ(evaluation.queries[1].metrics.second_tier, 1);
  EXPECT_EQ(evaluation.queries[2].metrics.nearest_neighbor, 1);
  EXPECT_EQ(evaluation.queries[3].metrics.nearest_neighbor, 1);
  EXPECT_DOUBLE_EQ(evaluation.mean.nearest_neighbor, 0.75);
  EXPECT_DOUBLE_EQ(evaluation.mean.second_tier, 1);
  EXPECT_DOUBLE_EQ(evaluation.precision_recall[0], (1 + 0.5 + 1 + 1) / 4);
}

TEST(EvaluateScores, SumsUpClassByClass) {
  const std::vector<std::string> classes = FiveItems();
  ASSERT_OK_AND_ASSIGN(const RetrievalEvaluation evaluation,
                       EvaluateScores(FiveScores(), classes));
  ASSERT_EQ(evaluation.classes.size(), 3u);
  EXPECT_EQ(evaluation.classes[0].name, "a");
  EXPECT_EQ(evaluation.classes[0].num_items, 2);
  EXPECT_DOUBLE_EQ(evaluation.classes[0].mean.nearest_neighbor, 0.5);
  EXPECT_DOUBLE_EQ(evaluation.classes[1].mean.nearest_neighbor, 1);
  EXPECT_EQ(evaluation.classes[2].num_items, 1);
  EXPECT_EQ(evaluation.classes[2].num_queries, 0);
}

TEST(EvaluateRankedLists, EqualsTheScoresTheyWereMadeFrom) {
  const std::vector<std::string> classes = FiveItems();
  const std::vector<std::vector<int32_t>> ranked = {{0, 2, 3, 1, 4},
                                                    {2, 3, 0, 4},
                                                    {2, 0, 1, 3, 4},
                                                    {1, 3, 4, 0, 2},
                                                    {0, 1, 2, 3}};
  ASSERT_OK_AND_ASSIGN(const RetrievalEvaluation lists,
                       EvaluateRankedLists(ranked, classes));
  ASSERT_OK_AND_ASSIGN(const RetrievalEvaluation scores,
                       EvaluateScores(FiveScores(), classes));
  EXPECT_EQ(lists.mean.dcg, scores.mean.dcg);
  EXPECT_EQ(lists.mean.average_precision, scores.mean.average_precision);
  EXPECT_EQ(lists.mean.first_tier, scores.mean.first_tier);
}

TEST(EvaluateRankedLists, RefusesWhatIsNoRanking) {
  const std::vector<std::string> classes = {"a", "a"};
  using Lists = std::vector<std::vector<int32_t>>;
  EXPECT_THAT(EvaluateRankedLists(Lists{{1}}, classes),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       HasSubstr("1 rankings of 2 items")));
  EXPECT_THAT(EvaluateRankedLists(Lists{{1}, {2}}, classes),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       HasSubstr("query 1: item 2 of 2")));
  EXPECT_THAT(EvaluateRankedLists(Lists{{1, 1}, {0}}, classes),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       HasSubstr("query 0: item 1 twice")));
}

TEST(EvaluateScores, RefusesScoresThatDoNotFit) {
  const std::vector<std::string> classes = {"a", "a"};
  EXPECT_THAT(EvaluateScores(Eigen::MatrixXd::Zero(2, 3), classes),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       HasSubstr("2 x 3 scores of 2 items")));
  Eigen::MatrixXd scores = Eigen::MatrixXd::Zero(2, 2);
  scores(1, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(
      EvaluateScores(scores, classes),
      StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("not a number")));
}

}  // namespace
}  // namespace argmesh
