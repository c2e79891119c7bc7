#include "server/rpc/convert_match.h"

#include <gtest/gtest.h>

#include "core/graph/shape_graph.h"
#include "core/matching/match.h"
#include "server/engine/error_reason.h"
#include "tests/support/random_graph.h"

namespace argmesh {
namespace {

TEST(ConvertMatch, ExplainsEveryScoreOfTheMatcherAsASum) {
  const MatchableGraph query(MakeRandomGraph(1));
  for (uint64_t seed = 1; seed <= 8; ++seed) {
    const MatchableGraph target(MakeRandomGraph(seed));
    for (const MatchMode mode : {MatchMode::kGlobal, MatchMode::kPartial}) {
      const MatchResult match = mode == MatchMode::kGlobal
                                    ? MatchGlobal(query, target)
                                    : MatchPartial(query, target);
      const v1::MatchExplanation explanation = Explain(match, mode);
      double sum = 0;
      for (const auto& term : explanation.terms()) sum += term.contribution();
      EXPECT_GT(explanation.terms_size(), 0) << "seed " << seed;
      EXPECT_NEAR(sum, match.score, 1e-5) << "seed " << seed;
    }
  }
}

TEST(ConvertMatch, ExplainsNothingThatIsNotASum) {
  MatchResult match;
  match.score = 0.9;
  match.level_scores = {{"a", 0.1f}, {"b", 0.2f}};
  match.best_level = "b";
  EXPECT_EQ(Explain(match, MatchMode::kGlobal).terms_size(), 0);
  EXPECT_EQ(Explain(match, MatchMode::kPartial).terms_size(), 0);
}

TEST(ConvertMatch, TakesTheTupleAloneInGlobalSearchesOnly) {
  v1::MatchParameters parameters;
  EXPECT_EQ(*FromProto("p", parameters, MatchMode::kPartial),
            AttributeSet::kFull);
  parameters.set_attributes(v1::ATTRIBUTE_SET_TUPLE);
  EXPECT_EQ(*FromProto("p", parameters, MatchMode::kGlobal),
            AttributeSet::kTuple);
  EXPECT_EQ(ReasonOf(FromProto("p", parameters, MatchMode::kPartial).status()),
            ErrorReason::kFieldInvalid);
  parameters.set_attributes(static_cast<v1::AttributeSet>(9));
  EXPECT_EQ(ReasonOf(FromProto("p", parameters, MatchMode::kGlobal).status()),
            ErrorReason::kFieldInvalid);
  parameters.clear_attributes();
  parameters.add_levels("count-16");
  EXPECT_EQ(ReasonOf(FromProto("p", parameters, MatchMode::kGlobal).status()),
            ErrorReason::kFieldInvalid);
}

TEST(ConvertMatch, CarriesPairsLevelsAndCoverage) {
  MatchResult match;
  match.score = 0.5;
  match.level_scores = {{"ncut-1.6", 0.25f}, {"uniform", 0.75f}};
  match.best_level = "uniform";
  match.best_query_level = 1;
  match.best_target_level = 2;
  match.query_coverage = 0.5;
  match.target_coverage = 0.25;
  match.pairs = {{3, 4, 0.5f}};
  const v1::Match proto = ToProto(match);
  EXPECT_EQ(proto.score(), 0.5);
  ASSERT_EQ(proto.level_scores_size(), 2);
  EXPECT_EQ(proto.level_scores(1).level(), "uniform");
  EXPECT_EQ(proto.level_scores(1).score(), 0.75);
  EXPECT_EQ(proto.best_level(), "uniform");
  EXPECT_EQ(proto.best_query_level(), 1);
  EXPECT_EQ(proto.best_target_level(), 2);
  EXPECT_EQ(proto.query_coverage(), 0.5);
  EXPECT_EQ(proto.target_coverage(), 0.25);
  ASSERT_EQ(proto.component_pairs_size(), 1);
  EXPECT_EQ(proto.component_pairs(0).query_node(), 3);
  EXPECT_EQ(proto.component_pairs(0).target_node(), 4);
  EXPECT_EQ(proto.component_pairs(0).similarity(), 0.5f);
}

}  // namespace
}  // namespace argmesh
