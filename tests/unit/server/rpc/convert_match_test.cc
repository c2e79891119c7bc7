#include "server/rpc/convert_match.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/graph/shape_graph.h"
#include "core/matching/match.h"
#include "server/engine/error_reason.h"
#include "tests/support/random_graph.h"

namespace argmesh {
namespace {

absl::StatusOr<MatchSettings> Settings(const v1::MatchParameters& parameters,
                                       MatchMode mode) {
  return FromProto("p", parameters, mode, false);
}

bool IsFieldInvalid(const absl::StatusOr<MatchSettings>& settings) {
  return ReasonOf(settings.status()) == ErrorReason::kFieldInvalid;
}

TEST(ConvertMatch, ExplainsEveryScoreOfTheMatcherAsASum) {
  const MatchableGraph query(MakeRandomGraph(1));
  for (uint64_t seed = 1; seed <= 8; ++seed) {
    const MatchableGraph target(MakeRandomGraph(seed));
    for (const MatchMode mode : {MatchMode::kGlobal, MatchMode::kPartial}) {
      SearchMatch match;
      match.match = mode == MatchMode::kGlobal ? MatchGlobal(query, target)
                                               : MatchPartial(query, target);
      match.score = match.match.score;
      const v1::MatchExplanation explanation = Explain(match, mode);
      double sum = 0;
      for (const auto& term : explanation.terms()) sum += term.contribution();
      EXPECT_GT(explanation.terms_size(), 0) << "seed " << seed;
      EXPECT_NEAR(sum, match.score, 1e-5) << "seed " << seed;
    }
  }
}

TEST(ConvertMatch, ExplainsNothingThatIsNotASum) {
  SearchMatch match;
  match.score = match.match.score = 0.9;
  match.match.level_scores = {{"a", 0.1f}, {"b", 0.2f}};
  match.match.best_level = "b";
  EXPECT_EQ(Explain(match, MatchMode::kGlobal).terms_size(), 0);
  EXPECT_EQ(Explain(match, MatchMode::kPartial).terms_size(), 0);
}

TEST(ConvertMatch, ExplainsAFusedScoreByItsTerms) {
  SearchMatch match;
  match.score = 0.5;
  match.candidate_rank = 7;
  match.terms = {{"graph", 0.25, 0.5}, {"signature", 0.75, 0.5}};
  const v1::MatchExplanation explanation = Explain(match, MatchMode::kGlobal);
  EXPECT_EQ(explanation.candidate_rank(), 7);
  ASSERT_EQ(explanation.terms_size(), 2);
  EXPECT_EQ(explanation.terms(1).name(), "signature");
  EXPECT_EQ(explanation.terms(1).contribution(), 0.375);
}

TEST(ConvertMatch, TakesTheTupleAloneInGlobalSearchesOnly) {
  v1::MatchParameters parameters;
  EXPECT_EQ(Settings(parameters, MatchMode::kPartial)->attributes,
            AttributeSet::kFull);
  parameters.set_attributes(v1::ATTRIBUTE_SET_TUPLE);
  EXPECT_EQ(Settings(parameters, MatchMode::kGlobal)->attributes,
            AttributeSet::kTuple);
  EXPECT_TRUE(IsFieldInvalid(Settings(parameters, MatchMode::kPartial)));
  parameters.set_attributes(static_cast<v1::AttributeSet>(9));
  EXPECT_TRUE(IsFieldInvalid(Settings(parameters, MatchMode::kGlobal)));
}

TEST(ConvertMatch, TakesTheLevelsThatCount) {
  v1::MatchParameters parameters;
  EXPECT_TRUE(Settings(parameters, MatchMode::kGlobal)->levels.empty());
  parameters.add_levels("count-16");
  EXPECT_THAT(Settings(parameters, MatchMode::kGlobal)->levels,
              testing::ElementsAre("count-16"));
}

TEST(ConvertMatch, RanksAGraphByGraphsAlone) {
  v1::MatchParameters parameters;
  EXPECT_EQ(Settings(parameters, MatchMode::kGlobal)->ranking,
            RankingMethod::kFused);
  EXPECT_EQ(FromProto("p", parameters, MatchMode::kGlobal, true)->ranking,
            RankingMethod::kGraph);
  parameters.set_ranking(v1::RANKING_METHOD_FUSED);
  EXPECT_TRUE(
      IsFieldInvalid(FromProto("p", parameters, MatchMode::kGlobal, true)));
  parameters.set_ranking(v1::RANKING_METHOD_GRAPH);
  EXPECT_EQ(Settings(parameters, MatchMode::kPartial)->ranking,
            RankingMethod::kGraph);
  parameters.set_ranking(static_cast<v1::RankingMethod>(9));
  EXPECT_TRUE(IsFieldInvalid(Settings(parameters, MatchMode::kGlobal)));
}

TEST(ConvertMatch, ReranksFusedSearchesOnly) {
  v1::MatchParameters parameters;
  parameters.set_rerank(true);
  EXPECT_TRUE(Settings(parameters, MatchMode::kGlobal)->rerank);
  EXPECT_TRUE(Settings(parameters, MatchMode::kPartial)->rerank);
  parameters.set_ranking(v1::RANKING_METHOD_GRAPH);
  EXPECT_TRUE(IsFieldInvalid(Settings(parameters, MatchMode::kGlobal)));
}

TEST(ConvertMatch, CarriesPairsLevelsAndCoverage) {
  SearchMatch found;
  found.score = 0.5;
  MatchResult& match = found.match;
  match.level_scores = {{"ncut-1.6", 0.25f}, {"uniform", 0.75f}};
  match.best_level = "uniform";
  match.best_query_level = 1;
  match.best_target_level = 2;
  match.query_coverage = 0.5;
  match.target_coverage = 0.25;
  match.pairs = {{3, 4, 0.5f}};
  const v1::Match proto = ToProto(found);
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
  EXPECT_EQ(proto.handedness(), v1::HANDEDNESS_UNSPECIFIED);
  EXPECT_FALSE(proto.has_containment());
}

TEST(ConvertMatch, SaysWhereTheQueryLies) {
  SearchMatch found;
  found.handedness = Handedness::kMirrored;
  found.tied = true;
  ContainmentMatch& containment = found.containment.emplace();
  containment.verified = true;
  containment.votes = 0.25;
  containment.fine_cover = 0.75;
  EXPECT_EQ(ToProto(found).containment().transform_size(), 0);
  containment.coarse_cover = 0.5;
  containment.transform(1, 3) = 8;
  containment.other_places.assign(2, containment.transform);
  containment.other_places[1](0, 3) = 4;
  containment.flipped = true;
  const v1::Match proto = ToProto(found);
  EXPECT_EQ(proto.handedness(), v1::HANDEDNESS_MIRRORED);
  EXPECT_TRUE(proto.containment().verified());
  EXPECT_TRUE(proto.containment().tied());
  EXPECT_EQ(proto.containment().window_score(), 0.25);
  EXPECT_EQ(proto.containment().surface_score(), 0.75);
  ASSERT_EQ(proto.containment().transform_size(), 16);
  EXPECT_EQ(proto.containment().transform(7), 8);
  ASSERT_EQ(proto.containment().other_places_size(), 2);
  EXPECT_EQ(proto.containment().other_places(1).transform(3), 4);
  EXPECT_TRUE(proto.containment().inside_out());
}

}  // namespace
}  // namespace argmesh
