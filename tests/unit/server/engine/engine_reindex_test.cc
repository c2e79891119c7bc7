// Reindexing a collection with other settings, on fakes.
#include <functional>
#include <map>
#include <stop_token>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/graph/shape_graph.h"
#include "tests/support/catalog_samples.h"
#include "tests/unit/server/engine/engine_bench.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

CollectionSettings OtherSettings() {
  CollectionSettings settings = QuickSettings();
  settings.vertex_budget = 250;
  settings.uniform_cells = 6;
  return settings;
}

class EngineReindexTest : public EngineTest {
 protected:
  void AddTori(const std::string& collection, const std::vector<int>& tenths) {
    for (const int t : tenths) Add(collection, absl::StrCat("t", t), t);
  }
  void Add(const std::string& collection, const std::string& id, int tenths) {
    NewShape shape = Named(id);
    shape.collection = collection;
    shape.if_exists = IfExists::kReplace;
    const auto added = engine_->AddShape(shape, TorusOff(tenths));
    ASSERT_TRUE(added.ok()) << added.status();
  }

  void MakeFresh(const CollectionSettings& settings) {
    NewCollection fresh;
    fresh.id = "fresh";
    fresh.settings = settings;
    ASSERT_THAT(engine_->CreateCollection(fresh), IsOk());
  }

  absl::StatusOr<ReindexReport> Reindex(
      const std::optional<CollectionSettings>& settings,
      RunControl control = {}) {
    return engine_->Reindex("cups", settings, control);
  }

  // Calls `act` once, when the first shape has been described.
  static RunControl AfterTheFirst(std::function<void()> act) {
    RunControl control;
    control.report = [act = std::move(act),
                      acted = false](const RunProgress& progress) mutable {
      if (progress.done == 0 || acted) return;
      acted = true;
      act();
    };
    return control;
  }

  // Digests of the graphs' bytes, by shape.
  std::map<std::string, std::string> GraphsOf(const std::string& collection) {
    std::map<std::string, std::string> graphs;
    const std::string uid = engine_->GetCollection(collection).value().uid;
    const std::vector<ScannedGraph> scanned =
        catalog_->ScanGraphs(uid, "", 1000).value();
    for (const ScannedGraph& graph : scanned) {
      graphs[graph.record.id] = ToHex(ComputeSha256(graph.graph));
    }
    return graphs;
  }
  // Scores by shape of a search with a mesh.
  std::map<std::string, double> ScoresOf(const std::string& collection) {
    SearchQuery query = SearchFor(MeshBytes{TorusOff(3)});
    query.collection = collection;
    std::map<std::string, double> scores;
    const auto answer = engine_->Search(query);
    EXPECT_TRUE(answer.ok()) << answer.status();
    if (!answer.ok()) return scores;
    for (const SearchMatch& match : answer->matches) {
      scores[match.shape.id] = match.score;
    }
    return scores;
  }
};

TEST_F(EngineReindexTest, GivesWhatACollectionOfTheNewSettingsHas) {
  AddTori("cups", {2, 3, 4});
  MakeFresh(OtherSettings());
  AddTori("fresh", {2, 3, 4});
  ASSERT_NE(GraphsOf("cups"), GraphsOf("fresh"));
  ASSERT_OK_AND_ASSIGN(const ShapeRecord before,
                       engine_->GetShape({"cups", "t2"}));
  ASSERT_OK_AND_ASSIGN(const ReindexReport report, Reindex(OtherSettings()));
  EXPECT_EQ(report.run.done, 3);
  EXPECT_EQ(report.run.failed, 0);
  EXPECT_EQ(report.collection.settings, OtherSettings());
  EXPECT_EQ(report.collection.generation, 4);
  EXPECT_EQ(report.collection, engine_->GetCollection("cups").value());
  EXPECT_EQ(GraphsOf("cups"), GraphsOf("fresh"));
  EXPECT_EQ(ScoresOf("cups"), ScoresOf("fresh"));
  ASSERT_OK_AND_ASSIGN(const ShapeRecord after,
                       engine_->GetShape({"cups", "t2"}));
  EXPECT_EQ(after.uid, before.uid);
  EXPECT_EQ(after.create_time, before.create_time);
  EXPECT_EQ(after.generation, 4);
  EXPECT_EQ(after.graph, engine_->GetShape({"fresh", "t2"}).value().graph);
  ASSERT_OK_AND_ASSIGN(const SearchAnswer answer,
                       engine_->Search(SearchFor(ShapeRef{"cups", "t3"})));
  EXPECT_EQ(answer.stats.generation, 4);
  EXPECT_EQ(answer.matches.at(0).shape.id, "t3");
  EXPECT_EQ(answer.matches.at(0).shape.generation, 4);
}

TEST_F(EngineReindexTest, AnswersAsBeforeAndTakesWritesWhileItRuns) {
  AddTori("cups", {2, 3, 4, 5});
  const std::map<std::string, double> old_scores = ScoresOf("cups");
  ASSERT_OK_AND_ASSIGN(
      const ReindexReport report,
      Reindex(
          OtherSettings(), AfterTheFirst([&] {
            EXPECT_EQ(ScoresOf("cups"), old_scores);
            EXPECT_EQ(engine_->GetCollection("cups").value().settings,
                      QuickSettings());
            Add("cups", "new", 6);
            Add("cups", "t2", 7);  // another mesh
            ShapePatch patch;
            patch.collection = "cups";
            patch.id = "t3";
            patch.display_name = "renamed";
            EXPECT_THAT(engine_->UpdateShape(patch), IsOk());
            EXPECT_THAT(engine_->DeleteShape({{"cups", "t4"}, "", {}}), IsOk());
          })));
  EXPECT_EQ(report.run.failed, 0);
  EXPECT_EQ(report.collection.settings, OtherSettings());
  MakeFresh(OtherSettings());
  AddTori("fresh", {3, 5});
  Add("fresh", "new", 6);
  Add("fresh", "t2", 7);
  EXPECT_EQ(GraphsOf("cups"), GraphsOf("fresh"));
  EXPECT_EQ(ScoresOf("cups"), ScoresOf("fresh"));
  EXPECT_EQ(engine_->GetShape({"cups", "t3"}).value().display_name, "renamed");
}

TEST_F(EngineReindexTest, DescribesAShapeThatComesMeanwhileWithBothSettings) {
  AddTori("cups", {2, 3});
  std::vector<std::string> unstaged = {"not asked"};
  const std::string uid = engine_->GetCollection("cups").value().uid;
  ASSERT_OK_AND_ASSIGN(const ReindexReport report,
                       Reindex(OtherSettings(), AfterTheFirst([&] {
                                 Add("cups", "a", 4);
                                 unstaged =
                                     catalog_->ListUnstaged(uid, "", 1).value();
                               })));
  // What came is put aside with it: the run does not have to come back to it.
  EXPECT_TRUE(unstaged.empty() || unstaged[0] != "a");
  EXPECT_EQ(report.run.done, 2);
  EXPECT_EQ(report.collection.settings, OtherSettings());
}

TEST_F(EngineReindexTest, GoesOnWhereItWasCancelledAndForgetsOtherSettings) {
  AddTori("cups", {2, 3, 4, 5});
  const auto cancelled = [&](const CollectionSettings& settings) {
    std::stop_source source;
    int64_t done = 0;
    RunControl control;
    control.stop = StopToken(source.get_token(), absl::InfiniteFuture());
    control.report = [&](const RunProgress& progress) {
      done = progress.done;
      if (done > 0) source.request_stop();
    };
    EXPECT_EQ(Reindex(settings, control).status().code(),
              absl::StatusCode::kCancelled);
    EXPECT_EQ(engine_->GetCollection("cups").value().settings, QuickSettings());
    return done;
  };
  const int64_t done = cancelled(OtherSettings());
  ASSERT_GT(done, 0);
  ASSERT_OK_AND_ASSIGN(const ReindexReport rest, Reindex(OtherSettings()));
  EXPECT_EQ(rest.run.done, 4 - done);
  EXPECT_EQ(rest.collection.settings, OtherSettings());

  // Back, with something else begun before.
  CollectionSettings third = OtherSettings();
  third.uniform_cells = 0;
  std::stop_source source;
  RunControl control;
  control.stop = StopToken(source.get_token(), absl::InfiniteFuture());
  control.report = [&](const RunProgress& progress) {
    if (progress.done > 0) source.request_stop();
  };
  EXPECT_FALSE(Reindex(third, control).ok());
  ASSERT_OK_AND_ASSIGN(const ReindexReport back, Reindex(QuickSettings()));
  EXPECT_EQ(back.run.done, 4);
  EXPECT_EQ(back.collection.settings, QuickSettings());
}

TEST_F(EngineReindexTest, StaysAsItWasWhenAShapeFails) {
  AddTori("cups", {2, 3, 4});
  const std::map<std::string, std::string> graphs = GraphsOf("cups");
  const std::map<std::string, double> scores = ScoresOf("cups");
  const int64_t generation = engine_->GetCollection("cups").value().generation;
  meshes_->Damage(ComputeSha256(TorusOff(3)));
  ASSERT_OK_AND_ASSIGN(const ReindexReport failed, Reindex(OtherSettings()));
  EXPECT_EQ(failed.run.done, 2);
  EXPECT_EQ(failed.run.failed, 1);
  ASSERT_EQ(failed.run.failures.size(), 1U);
  EXPECT_EQ(failed.run.failures[0].item, "t3");
  EXPECT_EQ(ReasonOrOk(failed.run.failures[0].status),
            ErrorReason::kStoredDataDamaged);
  EXPECT_EQ(failed.collection.settings, QuickSettings());
  EXPECT_EQ(failed.collection.generation, generation);
  EXPECT_EQ(GraphsOf("cups"), graphs);
  EXPECT_EQ(ScoresOf("cups"), scores);
  // Without the shape it takes no more than the switch.
  ASSERT_THAT(engine_->DeleteShape({{"cups", "t3"}, "", {}}), IsOk());
  ASSERT_OK_AND_ASSIGN(const ReindexReport rest, Reindex(OtherSettings()));
  EXPECT_EQ(rest.run.done, 0);
  EXPECT_EQ(rest.collection.settings, OtherSettings());
}

TEST_F(EngineReindexTest, RefusesWhatItCannotDo) {
  CollectionSettings settings = OtherSettings();
  settings.vertex_budget = 99;
  const absl::Status range = Reindex(settings).status();
  EXPECT_EQ(ReasonOrOk(range), ErrorReason::kFieldInvalid);
  EXPECT_EQ(MetadataOf(range).at("field"), "settings.vertex_budget");
  settings = OtherSettings();
  settings.store_meshes = false;
  const absl::Status meshes = engine_->CheckReindex("cups", settings);
  EXPECT_EQ(ReasonOrOk(meshes), ErrorReason::kFieldInvalid);
  EXPECT_EQ(MetadataOf(meshes).at("field"), "settings.store_meshes");
  EXPECT_EQ(ReasonOrOk(engine_->CheckReindex("none", std::nullopt)),
            ErrorReason::kCollectionNotFound);
  AddTori("cups", {2, 3});
  ErrorReason second{};
  ASSERT_THAT(Reindex(OtherSettings(), AfterTheFirst([&] {
                        second = ReasonOrOk(
                            engine_->CheckReindex("cups", OtherSettings()));
                      })),
              IsOk());
  EXPECT_EQ(second, ErrorReason::kOverloaded);
  EXPECT_THAT(engine_->CheckReindex("cups", OtherSettings()), IsOk());
}

TEST_F(EngineReindexTest, DoesNothingWithTheSettingsItHas) {
  AddTori("cups", {2});
  const CollectionRecord before = engine_->GetCollection("cups").value();
  ASSERT_OK_AND_ASSIGN(const ReindexReport report, Reindex(QuickSettings()));
  EXPECT_EQ(report.run.done, 0);
  EXPECT_EQ(report.collection, before);
}

TEST_F(EngineReindexTest, DescribesAgainAShapeThatASwitchOvertook) {
  const CollectionRecord cups = engine_->GetCollection("cups").value();
  const SettingsStage stage{OtherSettings(), kShapeGraphVersion};
  catalog_->BeforeNextPut([&] {
    ASSERT_THAT(catalog_->BeginStage("cups", cups.uid, stage), IsOk());
    ASSERT_THAT(
        catalog_->SwitchSettings({"cups", cups.uid, stage, absl::UnixEpoch()}),
        IsOk());
  });
  AddTori("cups", {3});
  MakeFresh(OtherSettings());
  AddTori("fresh", {3});
  EXPECT_EQ(GraphsOf("cups"), GraphsOf("fresh"));
  EXPECT_EQ(ScoresOf("cups"), ScoresOf("fresh"));
  EXPECT_EQ(meshes_->size(), 1U);
}

TEST_F(EngineReindexTest, ComparesAgainWhatASwitchCameBetween) {
  AddTori("cups", {2, 3});
  SearchQuery search = SearchFor(ShapeRef{"cups", "t2"});
  CompareQuery compare;
  compare.collection = "cups";
  compare.a = ShapeRef{"cups", "t2"};
  compare.b = ShapeRef{"cups", "t3"};
  ASSERT_OK_AND_ASSIGN(const ComparedShapes before, engine_->Compare(compare));
  ASSERT_OK_AND_ASSIGN(const ReindexReport report, Reindex(OtherSettings()));
  ASSERT_OK_AND_ASSIGN(const ComparedShapes after, engine_->Compare(compare));
  EXPECT_NE(before.match.match.score, after.match.match.score);
  // The switch is committed after a search has taken the old state.
  const auto switch_back = [&] {
    ASSERT_OK_AND_ASSIGN(const ReindexReport back, Reindex(QuickSettings()));
    EXPECT_EQ(back.collection.settings, QuickSettings());
  };
  catalog_->BeforeNextReadGraph(switch_back);
  ASSERT_OK_AND_ASSIGN(const ComparedShapes again, engine_->Compare(compare));
  EXPECT_EQ(again.match.match.score, before.match.match.score);
  catalog_->BeforeNextReadGraph([&] {
    ASSERT_OK_AND_ASSIGN(const ReindexReport other, Reindex(OtherSettings()));
    EXPECT_EQ(other.collection.settings, OtherSettings());
  });
  ASSERT_OK_AND_ASSIGN(const SearchAnswer answer, engine_->Search(search));
  ASSERT_EQ(answer.matches.size(), 2U);
  EXPECT_EQ(answer.matches[0].shape.id, "t2");
  EXPECT_EQ(answer.matches[1].match.score, after.match.match.score);
}

}  // namespace
}  // namespace argmesh
