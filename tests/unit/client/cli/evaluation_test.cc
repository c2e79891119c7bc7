#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "client/cli/evaluation_queries.h"
#include "client/cli/evaluation_run.h"
#include "tests/support/status_matchers.h"
#include "tests/unit/client/cli/scratch_folder.h"

namespace argmesh {
namespace {

using testing::HasSubstr;

Gallery ExampleGallery() {
  return Gallery({{"cup-1", "cup", "cup/1.off"},
                  {"cup-2", "cup", "cup/2.off"},
                  {"ant-1", "ant", "ant/1.off"},
                  {"thing", "", "thing.off"}});
}

TEST(Gallery, FindsASourceByItsPathOrItsId) {
  const Gallery gallery = ExampleGallery();
  EXPECT_EQ(gallery.FindSource("cup/2.off"), 1U);
  EXPECT_EQ(gallery.FindSource("ant-1"), 2U);
  EXPECT_EQ(gallery.FindSource("gone"), std::nullopt);
  EXPECT_EQ(gallery.CountOf("cup"), 2);
  EXPECT_EQ(gallery.CountOf("gone"), 0);
}

TEST(LeaveOneOutQueries, AreTheShapesWithAClass) {
  const auto queries = LeaveOneOutQueries(ExampleGallery());
  ASSERT_EQ(queries.size(), 3U);
  EXPECT_EQ(queries[2].name, "ant-1");
  EXPECT_EQ(queries[2].source, 2U);
}

TEST(ReadQueryTable, ResolvesPathsAndSources) {
  const ScratchFolder folder;
  const std::string table = folder.Add(
      "q/q.tsv", "path\tclass\tsource\na.off\tcup\tcup/2.off\nb.off\tant\t-\n");
  ASSERT_OK_AND_ASSIGN(const auto queries,
                       ReadQueryTable(table, ExampleGallery()));
  ASSERT_EQ(queries.size(), 2U);
  EXPECT_EQ(queries[0].file, folder.path() / "q" / "a.off");
  EXPECT_EQ(queries[0].source, 1U);
  EXPECT_EQ(queries[1].source, std::nullopt);
}

TEST(ReadQueryTable, RefusesASourceThatIsNotThere) {
  const ScratchFolder folder;
  const std::string table = folder.Add("q.tsv", "a.off\tcup\tcup/9.off\n");
  EXPECT_THAT(ReadQueryTable(table, ExampleGallery()),
              StatusIs(absl::StatusCode::kNotFound,
                       HasSubstr("line 1: the source cup/9.off")));
}

TEST(RowMargins, AreTheDiagonalLessTheBestOther) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> margins =
      RowMargins({{0.9, 0.5, 0.2}, {0.7, 0.6, none}, {0.1, 0.2, none}});
  EXPECT_NEAR(margins[0], 0.4, 1e-12);
  EXPECT_NEAR(margins[1], -0.1, 1e-12);
  EXPECT_TRUE(std::isnan(margins[2]));
}

Evaluation ExampleEvaluation() {
  Evaluation evaluation;
  evaluation.collection = "c";
  evaluation.mode = "partial";
  evaluation.mean = {
      .queries = 2, .nn = 1, .ft = 0.5, .st = 1, .e = 0.25, .dcg = 0.75};
  evaluation.per_class["cup"] = evaluation.mean;
  evaluation.per_query.push_back(
      {"cup-1", "cup", {.queries = 1, .ft = 0.25}, 3});
  evaluation.classes = {"ant", "cup"};
  evaluation.matrix = {{0.9, 0.5}, {0.4, 0.8}};
  return evaluation;
}

TEST(JsonOfAnEvaluation, HasTheKeysOfTheContract) {
  Evaluation evaluation = ExampleEvaluation();
  Json json = ToJson(evaluation);
  EXPECT_EQ(json["queries"], 2);
  EXPECT_EQ(json["nn"], 1.0);
  EXPECT_EQ(json["ft"], 0.5);
  EXPECT_EQ(json["st"], 1.0);
  EXPECT_EQ(json["e"], 0.25);
  EXPECT_EQ(json["dcg"], 0.75);
  EXPECT_EQ(json["per_class"]["cup"]["ft"], 0.5);
  EXPECT_EQ(json["matrix"]["diagonal_is_row_maximum"], true);
  EXPECT_FALSE(json.contains("source_first"));
  ASSERT_EQ(json["per_query"].size(), 1);
  EXPECT_EQ(json["per_query"][0]["query"], "cup-1");
  EXPECT_EQ(json["per_query"][0]["class"], "cup");
  EXPECT_EQ(json["per_query"][0]["ft"], 0.25);
  EXPECT_EQ(json["per_query"][0]["source_rank"], 3);
  evaluation.has_sources = true;
  evaluation.with_source = 2;
  evaluation.source_first = 0.5;
  evaluation.source_verified = 0.25;
  json = ToJson(evaluation);
  EXPECT_EQ(json["source_first"], 0.5);
  EXPECT_EQ(json["source_verified"], 0.25);
  EXPECT_EQ(json["other_class_verified"], 0);
  EXPECT_EQ(json["source_top5"], 0.0);
}

TEST(JsonOfAnEvaluation, SaysWhenAClassIsMoreLikeAnother) {
  Evaluation evaluation = ExampleEvaluation();
  evaluation.matrix[1][0] = 0.85;
  EXPECT_EQ(ToJson(evaluation)["matrix"]["diagonal_is_row_maximum"], false);
  EXPECT_THAT(ToText(evaluation), HasSubstr("not every class"));
}

}  // namespace
}  // namespace argmesh
