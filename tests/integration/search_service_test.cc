#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <chrono>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "core/mesh/mesh_write.h"
#include "tests/integration/server_fixture.h"
#include "tests/support/test_meshes.h"

namespace argmesh {
namespace {

class SearchServiceTest : public ::testing::Test {
 protected:
  void SetUp() override {
    server_.Start();
    server_.MakeCollection("c");
    server_.AddShape("c", "dumbbell", DumbbellOff());
    server_.AddShape("c", "sphere", SphereOff());
    generation_ = server_.AddShape("c", "torus", TorusOff()).generation();
  }

  static v1::SearchShapesRequest Request() {
    v1::SearchShapesRequest request;
    request.set_parent("collections/c");
    return request;
  }

  static v1::SearchShapesRequest ByShape(const std::string& id) {
    v1::SearchShapesRequest request = Request();
    request.set_shape("collections/c/shapes/" + id);
    return request;
  }

  grpc::Status Search(const v1::SearchShapesRequest& request,
                      v1::SearchShapesResponse* response) {
    grpc::ClientContext context;
    return server_.search().SearchShapes(&context, request, response);
  }

  grpc::Status Compare(const v1::CompareShapesRequest& request,
                       v1::CompareShapesResponse* response) {
    grpc::ClientContext context;
    return server_.search().CompareShapes(&context, request, response);
  }

  TestServer server_;
  int64_t generation_ = 0;
};

void ExpectOrdered(const v1::SearchShapesResponse& response) {
  for (int i = 1; i < response.matches_size(); ++i) {
    const v1::Match& a = response.matches(i - 1);
    const v1::Match& b = response.matches(i);
    EXPECT_TRUE(a.score() > b.score() ||
                (a.score() == b.score() && a.shape().name() < b.shape().name()))
        << a.shape().name() << " " << b.shape().name();
  }
}

TEST_F(SearchServiceTest, FindsAStoredShapeFirstWithScoreOne) {
  for (const auto mode : {v1::SEARCH_MODE_GLOBAL, v1::SEARCH_MODE_PARTIAL}) {
    v1::SearchShapesRequest request = ByShape("dumbbell");
    request.set_mode(mode);
    v1::SearchShapesResponse response;
    ASSERT_CALL_OK(Search(request, &response));
    ASSERT_EQ(response.matches_size(), 3);
    ExpectOrdered(response);
    const v1::Match& best = response.matches(0);
    EXPECT_EQ(best.shape().name(), "collections/c/shapes/dumbbell");
    EXPECT_EQ(best.score(), 1.0);
    EXPECT_GT(best.level_scores_size(), 0);
    EXPECT_FALSE(best.best_level().empty());
    EXPECT_NEAR(best.query_coverage(), 1.0, 1e-6);
    EXPECT_NEAR(best.target_coverage(), 1.0, 1e-6);
    EXPECT_GT(best.component_pairs_size(), 0);
    EXPECT_EQ(response.stats().generation(), generation_);
    EXPECT_EQ(response.stats().shapes_considered(), 3);
    EXPECT_EQ(response.stats().candidates_ranked(), 3);
    EXPECT_TRUE(response.stats().exhaustive());
    EXPECT_GT(response.stats().stage_times_size(), 0);
    EXPECT_FALSE(response.truncated());
  }
}

TEST_F(SearchServiceTest, FindsThePlaceOfAMovedCopy) {
  TriangleMesh copy = MakeDumbbell(16);
  copy.V *= 3;
  copy.V.rowwise() += Eigen::RowVector3d(5, 0, 0);
  v1::SearchShapesRequest request = Request();
  request.mutable_mesh()->set_data(
      SerializeMesh(copy, MeshFormat::kOff).value());
  request.set_mode(v1::SEARCH_MODE_PARTIAL);
  v1::SearchShapesResponse response;
  ASSERT_CALL_OK(Search(request, &response));
  ASSERT_EQ(response.matches_size(), 3);
  ExpectOrdered(response);
  const v1::Match& best = response.matches(0);
  EXPECT_EQ(best.shape().name(), "collections/c/shapes/dumbbell");
  EXPECT_LT(best.score(), 1);
  EXPECT_GT(best.containment().surface_score(), 0.95);
  EXPECT_GT(best.query_coverage(), 0.95);
  EXPECT_GT(best.target_coverage(), 0.95);
  // From the copy to the stored shape: a third of the size.
  const auto& transform = best.containment().transform();
  ASSERT_EQ(transform.size(), 16);
  const double length =
      std::sqrt(transform[0] * transform[0] + transform[4] * transform[4] +
                transform[8] * transform[8]);
  EXPECT_NEAR(length, 1.0 / 3, 0.02);
  EXPECT_EQ(transform[15], 1);
}

TEST_F(SearchServiceTest, FindsOnlyShapesThatTheFilterHoldsFor) {
  server_.DeclareKey("c", "mass", v1::METADATA_TYPE_NUMBER);
  server_.AddShape("c", "light", TorusOff(), {{"mass", "1"}});
  server_.AddShape("c", "heavy", DumbbellOff(), {{"mass", "9"}});
  for (const auto mode : {v1::SEARCH_MODE_GLOBAL, v1::SEARCH_MODE_PARTIAL}) {
    v1::SearchShapesRequest request = ByShape("dumbbell");
    request.set_mode(mode);
    request.set_limit(1);
    request.set_filter("mass < 5");
    v1::SearchShapesResponse response;
    ASSERT_CALL_OK(Search(request, &response));
    ASSERT_EQ(response.matches_size(), 1);
    EXPECT_EQ(response.matches(0).shape().name(), "collections/c/shapes/light");
    EXPECT_EQ(response.stats().shapes_considered(), 1);
    EXPECT_TRUE(response.stats().exhaustive());
    request.set_filter("mass:* AND NOT mass < 5");
    ASSERT_CALL_OK(Search(request, &response));
    ASSERT_EQ(response.matches_size(), 1);
    EXPECT_EQ(response.matches(0).shape().name(), "collections/c/shapes/heavy");
    request.set_filter("mass > 10");
    ASSERT_CALL_OK(Search(request, &response));
    EXPECT_EQ(response.matches_size(), 0);
    EXPECT_EQ(response.stats().shapes_considered(), 0);
  }
}

TEST_F(SearchServiceTest, CountsNoShapeThatIsLeftOut) {
  for (const auto mode : {v1::SEARCH_MODE_GLOBAL, v1::SEARCH_MODE_PARTIAL}) {
    v1::SearchShapesRequest request = ByShape("torus");
    request.set_mode(mode);
    request.set_exclude_query(true);
    v1::SearchShapesResponse response;
    ASSERT_CALL_OK(Search(request, &response));
    EXPECT_EQ(response.matches_size(), 2);
    EXPECT_EQ(response.stats().shapes_considered(), 2);
    EXPECT_EQ(response.stats().candidates_ranked(), 2);
    EXPECT_TRUE(response.stats().exhaustive());
  }
}

TEST_F(SearchServiceTest, TakesComponentsOfAStoredShapeAsTheQuery) {
  for (const auto mode : {v1::SEARCH_MODE_GLOBAL, v1::SEARCH_MODE_PARTIAL}) {
    v1::SearchShapesRequest request = ByShape("dumbbell");
    request.set_mode(mode);
    request.add_region_node_ids(0);
    request.set_return_query_graph(true);
    v1::SearchShapesResponse response;
    ASSERT_CALL_OK(Search(request, &response));
    EXPECT_EQ(response.matches_size(), 3);
    v1::SearchShapesRequest whole = ByShape("dumbbell");
    whole.set_return_query_graph(true);
    v1::SearchShapesResponse whole_response;
    ASSERT_CALL_OK(Search(whole, &whole_response));
    EXPECT_NE(response.query_graph().SerializeAsString(),
              whole_response.query_graph().SerializeAsString());
    EXPECT_GT(response.query_report().boundary_edges(), 0);
  }
}

TEST_F(SearchServiceTest, RanksAgainByNeighbourhoodOnlyWhenAsked) {
  v1::SearchShapesRequest request = ByShape("torus");
  v1::SearchShapesResponse plain;
  ASSERT_CALL_OK(Search(request, &plain));
  request.mutable_parameters()->set_rerank(true);
  v1::SearchShapesResponse reranked;
  ASSERT_CALL_OK(Search(request, &reranked));
  ASSERT_EQ(reranked.matches_size(), plain.matches_size());
  std::map<std::string, double> scores;
  for (const auto& match : plain.matches()) {
    scores[match.shape().name()] = match.score();
  }
  for (const auto& match : reranked.matches()) {
    EXPECT_EQ(match.score(), scores.at(match.shape().name()));
  }
}

TEST_F(SearchServiceTest, GivesAMeshAndItsGraphTheScoresOfTheStoredShape) {
  v1::SearchShapesResponse stored;
  ASSERT_CALL_OK(Search(ByShape("torus"), &stored));

  v1::SearchShapesRequest by_mesh = Request();
  by_mesh.mutable_mesh()->set_data(TorusOff());
  by_mesh.set_return_query_graph(true);
  v1::SearchShapesResponse mesh;
  ASSERT_CALL_OK(Search(by_mesh, &mesh));
  EXPECT_EQ(mesh.query_report().vertices(), 24 * 12);
  ASSERT_TRUE(mesh.has_query_graph());
  ASSERT_EQ(mesh.query_face_labels_size(), 2);
  EXPECT_EQ(mesh.query_face_labels(0).labels_size(), 2 * 24 * 12);
  EXPECT_EQ(mesh.query_face_labels(1).level(), "uniform");

  v1::SearchShapesRequest by_graph = Request();
  *by_graph.mutable_graph() = mesh.query_graph();
  v1::SearchShapesResponse graph;
  ASSERT_CALL_OK(Search(by_graph, &graph));
  v1::SearchShapesRequest ranked_by_graph = ByShape("torus");
  ranked_by_graph.mutable_parameters()->set_ranking(v1::RANKING_METHOD_GRAPH);
  v1::SearchShapesResponse stored_graph;
  ASSERT_CALL_OK(Search(ranked_by_graph, &stored_graph));

  ASSERT_EQ(mesh.matches_size(), stored.matches_size());
  ASSERT_EQ(graph.matches_size(), stored_graph.matches_size());
  for (int i = 0; i < stored.matches_size(); ++i) {
    EXPECT_EQ(mesh.matches(i).SerializeAsString(),
              stored.matches(i).SerializeAsString());
    EXPECT_EQ(graph.matches(i).SerializeAsString(),
              stored_graph.matches(i).SerializeAsString());
  }
  EXPECT_FALSE(graph.has_query_graph());
}

TEST_F(SearchServiceTest, LeavesOutWhatTheRequestRulesOut) {
  v1::SearchShapesRequest request = ByShape("torus");
  request.set_exclude_query(true);
  request.set_omit_component_pairs(true);
  v1::SearchShapesResponse response;
  ASSERT_CALL_OK(Search(request, &response));
  ASSERT_EQ(response.matches_size(), 2);
  for (const auto& match : response.matches()) {
    EXPECT_NE(match.shape().name(), "collections/c/shapes/torus");
    EXPECT_EQ(match.component_pairs_size(), 0);
  }
  const double best = response.matches(0).score();
  request.set_exclude_query(false);
  request.set_limit(1);
  ASSERT_CALL_OK(Search(request, &response));
  EXPECT_EQ(response.matches_size(), 1);
  request.set_limit(10);
  request.set_min_score((1 + best) / 2);
  ASSERT_CALL_OK(Search(request, &response));
  EXPECT_EQ(response.matches_size(), 1);
}

TEST_F(SearchServiceTest, ExplainsScoresAsSums) {
  for (const auto mode : {v1::SEARCH_MODE_GLOBAL, v1::SEARCH_MODE_PARTIAL}) {
    v1::SearchShapesRequest request = ByShape("sphere");
    request.set_mode(mode);
    request.set_explain(true);
    v1::SearchShapesResponse response;
    ASSERT_CALL_OK(Search(request, &response));
    for (const auto& match : response.matches()) {
      double sum = 0;
      for (const auto& term : match.explanation().terms()) {
        EXPECT_NEAR(term.contribution(), term.value() * term.weight(), 1e-9);
        sum += term.contribution();
      }
      EXPECT_GT(match.explanation().terms_size(), 0);
      EXPECT_NEAR(sum, match.score(), 1e-5) << match.shape().name();
    }
  }
}

TEST_F(SearchServiceTest, SeesAWriteWhoseGenerationItIsAskedFor) {
  v1::SearchShapesRequest request = ByShape("torus");
  for (int i = 0; i < 4; ++i) {
    const v1::Shape shape = server_.AddShape("c", "late-" + std::to_string(i),
                                             TorusOff(0.3 + 0.02 * i));
    request.set_min_generation(shape.generation());
    v1::SearchShapesResponse response;
    ASSERT_CALL_OK(Search(request, &response));
    EXPECT_EQ(response.matches_size(), 4 + i);
  }
  request.set_min_generation(1000);
  v1::SearchShapesResponse response;
  const grpc::Status status = Search(request, &response);
  EXPECT_FAILS(status, UNAVAILABLE, "GENERATION_NOT_REACHED");
  EXPECT_TRUE(ErrorOf(status).has_retry);
}

TEST_F(SearchServiceTest, AnswersTheSameAfterARestart) {
  v1::SearchShapesResponse before;
  v1::SearchShapesResponse after;
  ASSERT_CALL_OK(Search(ByShape("sphere"), &before));
  server_.Restart();
  ASSERT_CALL_OK(Search(ByShape("sphere"), &after));
  ASSERT_EQ(before.matches_size(), after.matches_size());
  for (int i = 0; i < before.matches_size(); ++i) {
    EXPECT_EQ(before.matches(i).SerializeAsString(),
              after.matches(i).SerializeAsString());
  }
}

TEST_F(SearchServiceTest, RefusesRequestsItCannotAnswer) {
  struct Row {
    const char* name;
    v1::SearchShapesRequest request;
    grpc::StatusCode code;
    const char* reason;
  };
  std::vector<Row> rows;
  const auto add = [&](const char* name, grpc::StatusCode code,
                       const char* reason) -> v1::SearchShapesRequest& {
    rows.push_back({name, ByShape("torus"), code, reason});
    return rows.back().request;
  };
  constexpr auto kInvalid = grpc::StatusCode::INVALID_ARGUMENT;
  add("no query", kInvalid, "FIELD_REQUIRED").clear_query();
  add("no parent", kInvalid, "FIELD_REQUIRED").clear_parent();
  add("other parent", grpc::StatusCode::NOT_FOUND, "COLLECTION_NOT_FOUND")
      .set_parent("collections/none");
  add("other shape", grpc::StatusCode::NOT_FOUND, "SHAPE_NOT_FOUND")
      .set_shape("collections/c/shapes/none");
  add("bad name", kInvalid, "NAME_INVALID").set_shape("torus");
  add("limit", kInvalid, "FIELD_INVALID").set_limit(1001);
  add("negative limit", kInvalid, "FIELD_INVALID").set_limit(-1);
  add("min_score", kInvalid, "FIELD_INVALID").set_min_score(1.5);
  add("coverage", kInvalid, "FIELD_INVALID").set_min_query_coverage(-0.1);
  add("mode", kInvalid, "FIELD_INVALID")
      .set_mode(static_cast<v1::SearchMode>(9));
  add("filter", kInvalid, "FILTER_INVALID").set_filter("= 1");
  add("key", kInvalid, "FILTER_KEY_UNDECLARED").set_filter("a = \"b\"");
  add("region", grpc::StatusCode::NOT_FOUND, "NODE_NOT_FOUND")
      .add_region_node_ids(99);
  v1::SearchShapesRequest& region_of_mesh =
      add("region of a mesh", kInvalid, "FIELD_INVALID");
  region_of_mesh.mutable_mesh()->set_data(TorusOff());
  region_of_mesh.add_region_node_ids(0);
  add("ranking", kInvalid, "FIELD_INVALID")
      .mutable_parameters()
      ->set_ranking(static_cast<v1::RankingMethod>(9));
  add("candidates", kInvalid, "FIELD_INVALID").set_candidates(-1);
  add("level that there is not", kInvalid, "FIELD_INVALID")
      .mutable_parameters()
      ->add_levels("count-17");
  add("empty mesh", kInvalid, "FIELD_REQUIRED").mutable_mesh();
  add("bad mesh", kInvalid, "MESH_FORMAT_UNKNOWN")
      .mutable_mesh()
      ->set_data("nothing of the kind, whatever one reads");
  add("graph of another version", grpc::StatusCode::FAILED_PRECONDITION,
      "GRAPH_VERSION_MISMATCH")
      .mutable_graph()
      ->set_version(77);
  add("graph without levels", kInvalid, "GRAPH_INVALID")
      .mutable_graph()
      ->set_version(1);
  for (const Row& row : rows) {
    v1::SearchShapesResponse response;
    const ErrorOf error(Search(row.request, &response));
    EXPECT_EQ(error.code, row.code) << row.name << ": " << error;
    EXPECT_EQ(error.reason, row.reason) << row.name << ": " << error;
  }
}

TEST_F(SearchServiceTest, ComparesTwoShapesAsASearchWould) {
  v1::SearchShapesResponse found;
  ASSERT_CALL_OK(Search(ByShape("torus"), &found));
  for (const auto& match : found.matches()) {
    v1::CompareShapesRequest request;
    request.set_parent("collections/c");
    request.mutable_query()->set_shape("collections/c/shapes/torus");
    request.mutable_target()->set_shape(match.shape().name());
    v1::CompareShapesResponse response;
    ASSERT_CALL_OK(Compare(request, &response));
    EXPECT_EQ(response.match().SerializeAsString(), match.SerializeAsString());
  }
}

TEST_F(SearchServiceTest, ComparesMeshesThatAreNotStored) {
  v1::CompareShapesRequest request;
  request.set_parent("collections/c");
  request.mutable_query()->mutable_mesh()->set_data(TorusOff());
  request.mutable_target()->mutable_mesh()->set_data(TorusOff());
  request.set_return_graphs(true);
  v1::CompareShapesResponse response;
  ASSERT_CALL_OK(Compare(request, &response));
  EXPECT_EQ(response.match().score(), 1.0);
  EXPECT_FALSE(response.match().has_shape());
  EXPECT_GT(response.query().graph().levels_size(), 0);
  EXPECT_EQ(response.target().report().faces(), 2 * 24 * 12);
  EXPECT_EQ(response.target().face_labels(0).labels_size(), 2 * 24 * 12);
  request.clear_target();
  EXPECT_FAILS(Compare(request, &response), INVALID_ARGUMENT, "FIELD_REQUIRED");
}

TEST_F(SearchServiceTest, HonoursADeadlineThatHasPassed) {
  v1::SearchShapesRequest request = Request();
  request.mutable_mesh()->set_data(SphereOff(200));
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() +
                       std::chrono::milliseconds(5));
  v1::SearchShapesResponse response;
  EXPECT_EQ(
      server_.search().SearchShapes(&context, request, &response).error_code(),
      grpc::StatusCode::DEADLINE_EXCEEDED);
  // The work stops too: nothing is left in flight soon after.
  EXPECT_TRUE(server_.Stop(absl::Seconds(5)));
}

TEST_F(SearchServiceTest, StopsASearchThatIsCancelled) {
  v1::SearchShapesRequest request = Request();
  request.mutable_mesh()->set_data(SphereOff(200));
  grpc::ClientContext context;
  v1::SearchShapesResponse response;
  grpc::CompletionQueue queue;
  const auto call =
      server_.search().AsyncSearchShapes(&context, request, &queue);
  grpc::Status status;
  int tag = 0;
  call->Finish(&response, &status, &tag);
  context.TryCancel();
  void* done = nullptr;
  bool ok = false;
  ASSERT_TRUE(queue.Next(&done, &ok));
  EXPECT_EQ(status.error_code(), grpc::StatusCode::CANCELLED);
  EXPECT_TRUE(server_.Stop(absl::Seconds(5)));
}

}  // namespace
}  // namespace argmesh
