#include "client/cli/json.h"

#include <gtest/gtest.h>

#include "client/error_status.h"

namespace argmesh {
namespace {

std::vector<std::string> Keys(const Json& json) {
  std::vector<std::string> keys;
  for (const auto& item : json.items()) keys.push_back(item.key());
  return keys;
}

v1::Match ExampleMatch() {
  v1::Match match;
  match.mutable_shape()->set_name("collections/c/shapes/cup-1");
  match.mutable_shape()->set_source_uri("cup/1.off");
  (*match.mutable_shape()->mutable_metadata())["class"] = "cup";
  (*match.mutable_shape()->mutable_metadata())["a"] = "b";
  match.set_score(0.5);
  match.set_best_level("uniform");
  for (const char* name : {"count-16", "uniform"}) {
    v1::LevelScore& level = *match.add_level_scores();
    level.set_level(name);
    level.set_score(0.25);
  }
  return match;
}

TEST(JsonOfAMatch, HasTheKeysOfTheContractInOrder) {
  const Json json = ToJson(ExampleMatch());
  const std::vector<std::string> keys = Keys(json);
  EXPECT_EQ(std::vector<std::string>(keys.begin(), keys.begin() + 8),
            (std::vector<std::string>{"shape", "score", "level_scores",
                                      "best_level", "query_coverage",
                                      "target_coverage", "class", "metadata"}));
  EXPECT_EQ(json["shape"], "cup-1");
  EXPECT_EQ(json["level_scores"].dump(), R"({"count-16":0.25,"uniform":0.25})");
  EXPECT_EQ(json["metadata"].dump(), R"({"a":"b","class":"cup"})");
  EXPECT_EQ(json["source_uri"], "cup/1.off");
  EXPECT_FALSE(json.contains("explanation"));
}

TEST(JsonOfAMatch, ExplainsTheScoreOnlyWhenTheServerDid) {
  v1::Match match = ExampleMatch();
  v1::ScoreTerm& term = *match.mutable_explanation()->add_terms();
  term.set_name("level uniform");
  term.set_contribution(0.5);
  EXPECT_EQ(ToJson(match)["explanation"]["terms"][0]["term"], "level uniform");
}

TEST(JsonOfAShape, TellsStateAndFormatInWords) {
  v1::Shape shape;
  shape.set_name("collections/c/shapes/s");
  shape.set_state(v1::SHAPE_STATE_ACTIVE);
  shape.mutable_mesh()->set_format(v1::MESH_FORMAT_OFF);
  const Json json = ToJson(shape);
  EXPECT_EQ(json["shape"], "s");
  EXPECT_EQ(json["state"], "active");
  EXPECT_EQ(json["mesh"]["format"], "off");
  EXPECT_EQ(json["class"], "");
}

TEST(JsonOfAGraph, HoldsOneLevelWhenOneIsAskedFor) {
  v1::ShapeGraph graph;
  graph.add_levels()->set_name("count-16");
  graph.mutable_uniform()->set_name("uniform");
  EXPECT_EQ(ToJson(graph, "")["levels"].size(), 2U);
  EXPECT_EQ(ToJson(graph, "uniform")["levels"].size(), 1U);
  EXPECT_EQ(ToJson(graph, "uniform")["levels"][0]["level"], "uniform");
}

TEST(JsonOfAnError, NamesCodeReasonAndMessage) {
  const Json json = ErrorToJson(
      MakeStatus(absl::StatusCode::kNotFound, "SHAPE_NOT_FOUND", "no shape x"));
  EXPECT_EQ(json.dump(), R"({"code":"NOT_FOUND","reason":"SHAPE_NOT_FOUND",)"
                         R"("message":"no shape x"})");
}

TEST(DecompositionName, IsTheWordOfTheCommandLine) {
  EXPECT_EQ(DecompositionName(v1::DECOMPOSITION_KIND_NORMAL_CURVATURE),
            "normal-curvature");
}

}  // namespace
}  // namespace argmesh
