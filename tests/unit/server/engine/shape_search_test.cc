#include "server/engine/shape_search.h"

#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "absl/time/clock.h"
#include "core/graph/graph_codec.h"
#include "tests/support/catalog_samples.h"
#include "tests/support/random_graph.h"
#include "tests/unit/server/engine/engine_bench.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> IdsOf(const SearchAnswer& answer) {
  std::vector<std::string> ids;
  for (const SearchMatch& match : answer.matches) ids.push_back(match.shape.id);
  return ids;
}

class ShapeSearchTest : public EngineTest {
 protected:
  void AddThree() {
    ASSERT_THAT(engine_->AddShape(Named("thin"), TorusOff(2)), IsOk());
    ASSERT_THAT(engine_->AddShape(Named("thick"), TorusOff(4)), IsOk());
    ASSERT_THAT(engine_->AddShape(Named("bell"), DumbbellOff()), IsOk());
  }
};

TEST_F(ShapeSearchTest, FindsTheSameMeshFirstWithAFullScore) {
  AddThree();
  for (const MatchMode mode : {MatchMode::kGlobal, MatchMode::kPartial}) {
    SearchQuery query = SearchFor(MeshBytes{DumbbellOff()});
    query.mode = mode;
    ASSERT_OK_AND_ASSIGN(const SearchAnswer answer, engine_->Search(query));
    ASSERT_EQ(answer.matches.size(), 3U);
    EXPECT_EQ(answer.matches[0].shape.id, "bell");
    EXPECT_EQ(answer.matches[0].score, 1);
    EXPECT_FALSE(answer.matches[0].match.pairs.empty());
    EXPECT_GE(answer.matches[1].score, answer.matches[2].score);
    EXPECT_EQ(answer.stats.generation, 3);
    EXPECT_EQ(answer.stats.shapes_matched, 3);
    EXPECT_TRUE(answer.stats.exhaustive);
  }
}

TEST_F(ShapeSearchTest, AnswersAStoredQueryAndAGraphLikeTheMesh) {
  AddThree();
  ASSERT_OK_AND_ASSIGN(const SearchAnswer by_mesh,
                       engine_->Search(SearchFor(MeshBytes{TorusOff(2)})));
  ASSERT_OK_AND_ASSIGN(const SearchAnswer by_id,
                       engine_->Search(SearchFor(ShapeRef{"cups", "thin"})));
  ASSERT_OK_AND_ASSIGN(const ShapeGraphAnswer stored,
                       engine_->GetGraph({"cups", "thin"}, false));
  ASSERT_OK_AND_ASSIGN(const SearchAnswer by_graph,
                       engine_->Search(SearchFor(stored.graph)));
  ASSERT_EQ(by_mesh.matches.size(), 3U);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(by_id.matches[i].shape.id, by_mesh.matches[i].shape.id);
    EXPECT_EQ(by_id.matches[i].match.score, by_mesh.matches[i].match.score);
    EXPECT_EQ(by_graph.matches[i].match.score, by_mesh.matches[i].match.score);
  }
}

TEST_F(ShapeSearchTest, KeepsToLimitScoreAndExclusion) {
  AddThree();
  SearchQuery query = SearchFor(ShapeRef{"cups", "thin"});
  query.limit = 1;
  EXPECT_THAT(IdsOf(engine_->Search(query).value()), ElementsAre("thin"));
  query.exclude_query = true;
  query.limit = 10;
  ASSERT_OK_AND_ASSIGN(const SearchAnswer others, engine_->Search(query));
  EXPECT_EQ(others.matches.size(), 2U);
  EXPECT_EQ(others.stats.shapes_considered, 2);
  query.exclude_query = false;
  query.min_score = 1;
  EXPECT_THAT(IdsOf(engine_->Search(query).value()), ElementsAre("thin"));
  query.min_score = 0;
  query.min_query_coverage = 1;
  ASSERT_OK_AND_ASSIGN(const SearchAnswer covered, engine_->Search(query));
  for (const SearchMatch& match : covered.matches) {
    EXPECT_GE(match.match.query_coverage, 1);
  }
  query.correspondence = false;
  query.query_graph = true;
  ASSERT_OK_AND_ASSIGN(const SearchAnswer bare, engine_->Search(query));
  EXPECT_TRUE(bare.matches.at(0).match.pairs.empty());
  EXPECT_TRUE(bare.query_graph.has_value());
}

TEST_F(ShapeSearchTest, AnswersAsManyAsTheFilterHoldsForWhateverRanksFirst) {
  CollectionPatch patch;
  patch.id = "cups";
  patch.metadata_keys = std::vector<MetadataKey>{{"n", MetadataType::kNumber}};
  ASSERT_THAT(engine_->UpdateCollection(patch), IsOk());
  for (int i = 0; i < 8; ++i) {
    NewShape shape = Named("s" + std::to_string(i));
    shape.metadata["n"] = std::to_string(i);
    const std::string mesh = i < 5 ? DumbbellOff() : TorusOff(i);
    ASSERT_THAT(engine_->AddShape(shape, mesh), IsOk());
  }
  for (const MatchMode mode : {MatchMode::kGlobal, MatchMode::kPartial}) {
    SearchQuery query = SearchFor(ShapeRef{"cups", "s0"});
    query.mode = mode;
    query.candidates = 2;  // all of them dumbbells, were it not for the filter
    query.limit = 2;
    query.filter = "n >= 4";
    ASSERT_OK_AND_ASSIGN(const SearchAnswer answer, engine_->Search(query));
    ASSERT_EQ(answer.matches.size(), 2U);
    EXPECT_EQ(answer.matches[0].shape.id, "s4");
    EXPECT_GE(answer.matches[1].shape.id, "s5");
    EXPECT_EQ(answer.stats.shapes_considered, 4);
    query.filter = "n < 2";
    query.exclude_query = true;
    ASSERT_OK_AND_ASSIGN(const SearchAnswer rest, engine_->Search(query));
    EXPECT_THAT(IdsOf(rest), ElementsAre("s1"));
  }
}

TEST_F(ShapeSearchTest, BreaksTiesById) {
  for (const char* id : {"c", "a", "b"}) {
    ASSERT_THAT(engine_->AddShape(Named(id), TorusOff(3)), IsOk());
  }
  SearchQuery query = SearchFor(ShapeRef{"cups", "c"});
  EXPECT_THAT(IdsOf(engine_->Search(query).value()),
              ElementsAre("a", "b", "c"));
  query.limit = 2;
  EXPECT_THAT(IdsOf(engine_->Search(query).value()), ElementsAre("a", "b"));
}

TEST_F(ShapeSearchTest, SeesEveryWriteThatReturned) {
  const SearchQuery query = SearchFor(MeshBytes{TorusOff(3)});
  EXPECT_THAT(IdsOf(engine_->Search(query).value()), ElementsAre());
  ASSERT_OK_AND_ASSIGN(const AddedShape added,
                       engine_->AddShape(Named("a"), TorusOff(3)));
  SearchQuery fresh = query;
  fresh.min_generation = added.record.generation;
  EXPECT_THAT(IdsOf(engine_->Search(fresh).value()), ElementsAre("a"));
  ShapePatch patch;
  patch.collection = "cups";
  patch.id = "a";
  patch.display_name = "A";
  ASSERT_THAT(engine_->UpdateShape(patch), IsOk());
  EXPECT_EQ(engine_->Search(query).value().matches.at(0).shape.display_name,
            "A");
  ASSERT_THAT(engine_->DeleteShape({{"cups", "a"}, "", {}}), IsOk());
  EXPECT_THAT(IdsOf(engine_->Search(query).value()), ElementsAre());
  fresh.min_generation = 4;
  EXPECT_EQ(ReasonOrOk(engine_->Search(fresh)),
            ErrorReason::kGenerationNotReached);
}

TEST_F(ShapeSearchTest, ForgetsADeletedCollection) {
  AddThree();
  EXPECT_EQ(ReasonOrOk(engine_->DeleteCollection({"cups", false, ""})),
            ErrorReason::kCollectionNotEmpty);
  ASSERT_THAT(engine_->DeleteCollection({"cups", true, ""}), IsOk());
  EXPECT_EQ(meshes_->size(), 0U);
  const SearchQuery query = SearchFor(MeshBytes{TorusOff(3)});
  EXPECT_EQ(ReasonOrOk(engine_->Search(query)),
            ErrorReason::kCollectionNotFound);
  NewCollection cups;
  cups.id = "cups";
  cups.settings = QuickSettings();
  ASSERT_THAT(engine_->CreateCollection(cups), IsOk());
  EXPECT_THAT(IdsOf(engine_->Search(query).value()), ElementsAre());
}

TEST_F(ShapeSearchTest, RefusesGraphsThatCannotBeCompared) {
  AddThree();
  NewCollection other;
  other.id = "other";
  other.settings = QuickSettings();
  other.settings.vertex_budget = 301;
  ASSERT_THAT(engine_->CreateCollection(other), IsOk());
  SearchQuery query = SearchFor(ShapeRef{"cups", "thin"});
  query.collection = "other";
  EXPECT_EQ(ReasonOrOk(engine_->Search(query)),
            ErrorReason::kGraphVersionMismatch);
  ShapeGraph broken = MakeRandomGraph(1);
  broken.levels[1].nodes[0].parent = 99;
  EXPECT_EQ(ReasonOrOk(engine_->Search(SearchFor(broken))),
            ErrorReason::kGraphInvalid);
  EXPECT_EQ(ReasonOrOk(engine_->Search(SearchFor(ShapeRef{"cups", "x"}))),
            ErrorReason::kShapeNotFound);
}

TEST_F(ShapeSearchTest, ComparesAnyTwoShapes) {
  AddThree();
  CompareQuery query;
  query.collection = "cups";
  query.a = ShapeRef{"cups", "thin"};
  query.b = MeshBytes{TorusOff(2)};
  query.graphs = true;
  ASSERT_OK_AND_ASSIGN(const ComparedShapes same, engine_->Compare(query));
  EXPECT_EQ(same.match.score, 1);
  EXPECT_EQ(same.a->graph, same.b->graph);
  query.b = ShapeRef{"cups", "bell"};
  ASSERT_OK_AND_ASSIGN(const ComparedShapes other, engine_->Compare(query));
  EXPECT_LT(other.match.score, 1);
}

// The ball of a dumbbell above z = 0.
TriangleMesh UpperHalf(const TriangleMesh& mesh) {
  TriangleMesh half = mesh;
  int faces = 0;
  for (int f = 0; f < mesh.num_faces(); ++f) {
    if (mesh.V(mesh.F(f, 0), 2) > 0) half.F.row(faces++) = mesh.F.row(f);
  }
  half.F.conservativeResize(faces, Eigen::NoChange);
  RemoveUnusedVertices(half);
  return half;
}

std::string Off(const TriangleMesh& mesh) {
  return SerializeMesh(mesh, MeshFormat::kOff).value();
}

TEST_F(ShapeSearchTest, PairsTheComponentsThatLieOnEachOther) {
  const TriangleMesh whole = MakeDumbbell(24);
  ASSERT_THAT(engine_->AddShape(Named("bell"), Off(whole)), IsOk());
  ASSERT_THAT(engine_->AddShape(Named("thin"), TorusOff(2)), IsOk());
  SearchQuery query =
      SearchFor(MeshBytes{Off(RandomlyMoved(UpperHalf(whole), 5))});
  query.mode = MatchMode::kPartial;
  ASSERT_OK_AND_ASSIGN(const SearchAnswer answer, engine_->Search(query));
  const SearchMatch& first = answer.matches.at(0);
  ASSERT_EQ(first.shape.id, "bell");
  ASSERT_TRUE(first.containment->verified);
  ASSERT_FALSE(first.match.pairs.empty());
  // Both balls hold the query: which of them is a matter of chance.
  EXPECT_EQ(first.containment->other_places.size(), 1U);
  EXPECT_TRUE(first.tied);
  double best = 0;
  for (const NodePair& pair : first.match.pairs) {
    best = std::max(best, static_cast<double>(pair.similarity));
  }
  EXPECT_GT(best, 0.5);
  EXPECT_EQ(answer.stats.stages.back().stage, "placement");
}

TEST_F(ShapeSearchTest, RanksWhatHasNoWindowsByItsGraph) {
  TriangleMesh strip = MakeSheet(40);
  strip.V.col(1) *= 0.004;
  ASSERT_THAT(engine_->AddShape(Named("strip"), Off(strip)), IsOk());
  ASSERT_THAT(engine_->AddShape(Named("thin"), TorusOff(2)), IsOk());
  SearchQuery query = SearchFor(MeshBytes{Off(strip)});
  query.mode = MatchMode::kPartial;
  ASSERT_OK_AND_ASSIGN(const SearchAnswer answer, engine_->Search(query));
  EXPECT_TRUE(answer.query_generic);
  EXPECT_EQ(answer.matches.at(0).shape.id, "strip");
  EXPECT_EQ(answer.matches.at(0).score, 1);
  EXPECT_FALSE(answer.matches.at(0).containment.has_value());
}

TEST_F(ShapeSearchTest, RanksMoreShapesAgainThanItAnswers) {
  for (int i = 1; i < 9; ++i) {
    ASSERT_THAT(
        engine_->AddShape(Named("torus" + std::to_string(i)), TorusOff(i)),
        IsOk());
  }
  SearchQuery query = SearchFor(MeshBytes{DumbbellOff()});
  query.rerank = true;
  const std::vector<std::string> all = IdsOf(engine_->Search(query).value());
  ASSERT_EQ(all.size(), 8U);
  for (const int limit : {1, 2, 5}) {
    query.limit = limit;
    EXPECT_EQ(IdsOf(engine_->Search(query).value()),
              std::vector<std::string>(all.begin(), all.begin() + limit));
  }
}

TEST_F(ShapeSearchTest, RanksWhatIsLikeAHolderOfThePieceBeforeOthers) {
  const TriangleMesh whole = MakeDumbbell(24);
  TriangleMesh stretched = whole;
  stretched.V.col(2) *= 1.3;  // its balls are none
  ASSERT_THAT(engine_->AddShape(Named("bell"), Off(whole)), IsOk());
  ASSERT_THAT(engine_->AddShape(Named("long"), Off(stretched)), IsOk());
  for (int i = 2; i < 9; ++i) {
    ASSERT_THAT(
        engine_->AddShape(Named("torus" + std::to_string(i)), TorusOff(i)),
        IsOk());
  }
  SearchQuery query =
      SearchFor(MeshBytes{Off(RandomlyMoved(UpperHalf(whole), 5))});
  query.mode = MatchMode::kPartial;
  ASSERT_OK_AND_ASSIGN(const SearchAnswer plain, engine_->Search(query));
  ASSERT_TRUE(plain.matches.at(0).containment->verified);
  query.rerank = true;
  query.limit = 2;
  EXPECT_THAT(IdsOf(engine_->Search(query).value()),
              ElementsAre("bell", "long"));
  // Without a holder nobody vouches.
  ASSERT_THAT(engine_->DeleteShape({{"cups", "bell"}, "", {}}), IsOk());
  query.limit = 10;
  const std::vector<std::string> order = IdsOf(engine_->Search(query).value());
  query.rerank = false;
  EXPECT_EQ(IdsOf(engine_->Search(query).value()), order);
}

TEST_F(ShapeSearchTest, ComparesAPieceWithItsWholeByWhereItLies) {
  const TriangleMesh whole = MakeDumbbell(24);
  CompareQuery query;
  query.collection = "cups";
  query.mode = MatchMode::kPartial;
  query.a = MeshBytes{Off(RandomlyMoved(UpperHalf(whole), 5))};
  query.b = MeshBytes{Off(whole)};
  ASSERT_OK_AND_ASSIGN(const ComparedShapes in, engine_->Compare(query));
  ASSERT_TRUE(in.match.containment.has_value());
  EXPECT_TRUE(in.match.containment->verified);
  EXPECT_FALSE(in.match.match.pairs.empty());
  query.b = MeshBytes{TorusOff(2)};
  ASSERT_OK_AND_ASSIGN(const ComparedShapes out, engine_->Compare(query));
  EXPECT_FALSE(out.match.containment->verified);
  EXPECT_LT(out.match.score, in.match.score);
  query.b = query.a;
  ASSERT_OK_AND_ASSIGN(const ComparedShapes same, engine_->Compare(query));
  EXPECT_EQ(same.match.score, 1);
  query.ranking = RankingMethod::kGraph;
  ASSERT_OK_AND_ASSIGN(const ComparedShapes graphs, engine_->Compare(query));
  EXPECT_FALSE(graphs.match.containment.has_value());
}

TEST_F(ShapeSearchTest, StopsWhenItIsCancelled) {
  ASSERT_OK_AND_ASSIGN(const CollectionRecord cups,
                       engine_->GetCollection("cups"));
  for (int i = 0; i < 1500; ++i) {
    ASSERT_THAT(catalog_->PutShape(SamplePut(cups, "s" + std::to_string(i),
                                             static_cast<uint64_t>(i % 10))),
                IsOk());
  }
  ASSERT_THAT(engine_->AddShape(Named("last"), TorusOff(3)), IsOk());
  const SearchQuery query = SearchFor(MakeRandomGraph(77));
  std::stop_source source;
  const StopToken stop(source.get_token(), absl::InfiniteFuture());
  const std::jthread canceller([&] {
    absl::SleepFor(absl::Milliseconds(5));
    source.request_stop();
  });
  // One that began before the cancellation may still come to its end.
  absl::Status status;
  while (status.ok()) status = engine_->Search(query, stop).status();
  EXPECT_EQ(ReasonOf(status), ErrorReason::kCancelled);
}

}  // namespace
}  // namespace argmesh
