// The program `argmesh` against a real server: what people and scripts rely on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

#include "tests/e2e/installation.h"

namespace argmesh {
namespace {

using testing::HasSubstr;
using Words = std::vector<std::string>;
using OrderedJson = nlohmann::ordered_json;

// Two shapes of each of four classes, ingested once for all tests.
class CommandLineTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    installation_ = std::make_unique<Installation>();
    ASSERT_TRUE(installation_->StartServer());
    const CommandOutcome sample =
        Run({"sample", "--out", Path("meshes"), "--shapes-per-class", "2",
             "--classes", "mug,quadruped,table,wrench", "--vertices", "1500"});
    ASSERT_EQ(sample.exit_code, 0) << sample.err;
    first_ingest_ = Run({"ingest", "--collection", "demo", "--labels",
                         Path("meshes/labels.tsv"), Path("meshes"), "--json"});
  }
  static void TearDownTestSuite() {
    EXPECT_TRUE(installation_->ServerRuns()) << installation_->ServerLog();
    installation_.reset();
  }

  static CommandOutcome Run(const Words& words) {
    return installation_->Run(words);
  }
  static std::string Path(const std::string& relative) {
    return (installation_->folder() / relative).string();
  }

  // The ids of the shapes of a class.
  static Words ShapesOf(const std::string& name) {
    Words ids;
    const OrderedJson list =
        Run({"list", "--collection", "demo", "--json"}).Json();
    for (const auto& shape : list["shapes"]) {
      if (shape["class"] == name) ids.push_back(shape["shape"]);
    }
    return ids;
  }

  static void ExpectPng(const std::string& file) {
    const std::string bytes = installation_->ReadFile(file);
    EXPECT_TRUE(bytes.starts_with("\x89PNG\r\n\x1a\n")) << file;
    EXPECT_GT(bytes.size(), 1000U) << file;
  }

  static std::unique_ptr<Installation> installation_;
  static CommandOutcome first_ingest_;
};

std::unique_ptr<Installation> CommandLineTest::installation_;
CommandOutcome CommandLineTest::first_ingest_;

TEST_F(CommandLineTest, IngestsAFolderWithItsLabels) {
  ASSERT_EQ(first_ingest_.exit_code, 0) << first_ingest_.err;
  const OrderedJson summary = first_ingest_.Json();
  EXPECT_EQ(summary["ingested"], 8);
  EXPECT_EQ(summary["already_stored"], 0);
  EXPECT_EQ(summary["failed"], 0);
  EXPECT_EQ(summary["failures"].size(), 0U);
  EXPECT_GT(summary["seconds"], 0);
  const OrderedJson list =
      Run({"list", "--collection", "demo", "--json"}).Json();
  ASSERT_EQ(list["shapes"].size(), 8U);
  EXPECT_EQ(list["shapes"][0]["state"], "active");
  EXPECT_EQ(list["shapes"][0]["source_uri"], "mug/mug-01.off");
  EXPECT_EQ(list["shapes"][0]["metadata"]["class"], "mug");
}

TEST_F(CommandLineTest, SendsNothingTwice) {
  const CommandOutcome again =
      Run({"ingest", "--collection", "demo", "--labels",
           Path("meshes/labels.tsv"), Path("meshes"), "--json"});
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_EQ(again.Json()["ingested"], 0);
  EXPECT_EQ(again.Json()["already_stored"], 8);
}

TEST_F(CommandLineTest, NamesADamagedFileAndStoresTheGoodOnes) {
  const std::string good = installation_->ReadFile("meshes/mug/mug-01.off");
  installation_->WriteFile("mixed/good.off", good);
  installation_->WriteFile("mixed/damaged.off", "OFF\n3 1 0\n0 0 0\n1 0");
  installation_->WriteFile("mixed/empty.stl", "");
  installation_->WriteFile(
      "mixed/sub/Good.OFF",
      installation_->ReadFile("meshes/table/table-01.off"));
  const CommandOutcome outcome =
      Run({"ingest", "--collection", "mixed", Path("mixed"), "--json"});
  EXPECT_EQ(outcome.exit_code, 1);
  const OrderedJson summary = outcome.Json();
  EXPECT_EQ(summary["ingested"], 2);
  EXPECT_EQ(summary["failed"], 2);
  ASSERT_EQ(summary["failures"].size(), 2U);
  EXPECT_THAT(summary["failures"][0]["path"].get<std::string>(),
              HasSubstr("damaged.off"));
  EXPECT_EQ(summary["failures"][0]["reason"], "MESH_MALFORMED");
  EXPECT_EQ(summary["failures"][1]["reason"], "MESH_EMPTY");
  EXPECT_THAT(outcome.err, HasSubstr("damaged.off"));
}

TEST_F(CommandLineTest, RefusesAnotherMeshUnlessToldToReplace) {
  installation_->WriteFile("one/x.off",
                           installation_->ReadFile("meshes/mug/mug-01.off"));
  const Words ingest = {"ingest", "--collection", "one", Path("one"), "--json"};
  ASSERT_EQ(Run(ingest).exit_code, 0);
  installation_->WriteFile("one/x.off",
                           installation_->ReadFile("meshes/mug/mug-02.off"));
  const CommandOutcome refused = Run(ingest);
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_EQ(refused.Json()["failures"][0]["reason"], "SHAPE_EXISTS");
  Words replace = ingest;
  replace.push_back("--replace");
  const CommandOutcome replaced = Run(replace);
  EXPECT_EQ(replaced.exit_code, 0) << replaced.err;
  EXPECT_EQ(replaced.Json()["ingested"], 1);
  EXPECT_EQ(Run(ingest).Json()["already_stored"], 1);
}

TEST_F(CommandLineTest, FindsAStoredShapeFirstByItsFile) {
  for (const std::string mode : {"global", "partial"}) {
    SCOPED_TRACE(mode);
    const CommandOutcome outcome =
        Run({"search", "--collection", "demo", "--mode", mode, "--limit", "3",
             "--json", Path("meshes/wrench/wrench-02.off")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const OrderedJson json = outcome.Json();
    ASSERT_EQ(json["matches"].size(), 3U);
    const OrderedJson& best = json["matches"][0];
    EXPECT_EQ(best["source_uri"], "wrench/wrench-02.off");
    EXPECT_NEAR(best["score"].get<double>(), 1, 1e-6);
    EXPECT_GE(best["score"], json["matches"][1]["score"]);
    for (const char* key : {"shape", "score", "level_scores", "best_level",
                            "query_coverage", "target_coverage", "metadata"}) {
      EXPECT_TRUE(best.contains(key)) << key;
    }
    EXPECT_EQ(best["metadata"]["class"], "wrench");
    EXPECT_EQ(json["stats"]["shapes_considered"], 8);
  }
}

TEST_F(CommandLineTest, SearchesByAFileLargerThanAMessage) {
  const std::string padding(5 << 20, '\n');
  installation_->WriteFile(
      "large.off",
      installation_->ReadFile("meshes/wrench/wrench-02.off") + padding);
  const CommandOutcome outcome =
      Run({"search", "--collection", "demo", "--limit", "3", "--json",
           Path("large.off")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const OrderedJson json = outcome.Json();
  ASSERT_EQ(json["matches"].size(), 3U);
  EXPECT_EQ(json["matches"][0]["source_uri"], "wrench/wrench-02.off");
  EXPECT_EQ(json["stats"]["shapes_considered"], 8);
  EXPECT_EQ(json["truncated"], false);
}

TEST_F(CommandLineTest, FiltersByDeclaredMetadata) {
  const Words list = {"list",     "--collection",  "demo",
                      "--filter", "class = table", "--json"};
  const CommandOutcome undeclared = Run(list);
  EXPECT_EQ(undeclared.exit_code, 1);
  EXPECT_EQ(undeclared.Json()["error"]["reason"], "FILTER_KEY_UNDECLARED");
  EXPECT_EQ(Run({"declare", "--collection", "demo", "class"}).exit_code, 2);
  const CommandOutcome declared =
      Run({"declare", "--collection", "demo", "class:string", "--json"});
  ASSERT_EQ(declared.exit_code, 0) << declared.err;
  EXPECT_EQ(declared.Json()["metadata_keys"]["class"], "string");
  const OrderedJson tables = Run(list).Json();
  ASSERT_EQ(tables["shapes"].size(), 2U);
  for (const auto& shape : tables["shapes"]) EXPECT_EQ(shape["class"], "table");
  const CommandOutcome search =
      Run({"search", "--collection", "demo", "--filter",
           "NOT (class = mug OR class = table)", "--json",
           Path("meshes/mug/mug-01.off")});
  ASSERT_EQ(search.exit_code, 0) << search.err;
  EXPECT_EQ(search.Json()["matches"].size(), 4U);
  const CommandOutcome evaluated =
      Run({"evaluate", "--collection", "demo", "--filter",
           "class = mug OR class = table", "--json"});
  ASSERT_EQ(evaluated.exit_code, 0) << evaluated.err;
  EXPECT_EQ(evaluated.Json()["queries"], 4);
}

TEST_F(CommandLineTest, LeavesAStoredQueryOutOfItsAnswer) {
  const std::string id = ShapesOf("mug").at(0);
  const Words search = {"search", "--collection", "demo", "--mode",
                        "global", "--shape",      id,     "--json"};
  const OrderedJson without = Run(search).Json();
  ASSERT_EQ(without["matches"].size(), 7U);
  for (const auto& match : without["matches"]) EXPECT_NE(match["shape"], id);
  Words including = search;
  including.push_back("--include-self");
  EXPECT_EQ(Run(including).Json()["matches"][0]["shape"], id);
}

TEST_F(CommandLineTest, ShowsTablesToPeople) {
  const CommandOutcome search =
      Run({"search", "--collection", "demo", "--explain",
           Path("meshes/mug/mug-01.off")});
  EXPECT_EQ(search.exit_code, 0);
  EXPECT_THAT(search.out, HasSubstr("best level"));
  EXPECT_THAT(search.out, HasSubstr("1.0000"));
  const CommandOutcome list = Run({"list"});
  EXPECT_THAT(list.out, HasSubstr("demo"));
  const CommandOutcome graph =
      Run({"graph", "--collection", "demo", ShapesOf("mug").at(0)});
  EXPECT_THAT(graph.out, HasSubstr("components"));
  EXPECT_THAT(Run({"info"}).out, HasSubstr("graph_version"));
  EXPECT_THAT(Run({"get", "--collection", "demo"}).out,
              HasSubstr("shape_count"));
}

TEST_F(CommandLineTest, ComparesShapesAndFiles) {
  const std::string id = ShapesOf("table").at(0);
  const OrderedJson same = Run({"compare", "--collection", "demo", id,
                                Path("meshes/table/table-01.off"), "--json"})
                               .Json();
  EXPECT_NEAR(same["score"].get<double>(), 1, 1e-6);
  EXPECT_EQ(same["a"], id);
  const OrderedJson other = Run({"compare", "--collection", "demo", id,
                                 ShapesOf("mug").at(0), "--json"})
                                .Json();
  EXPECT_LT(other["score"], same["score"]);
}

TEST_F(CommandLineTest, GivesBackTheBytesOfAMesh) {
  const std::string id = ShapesOf("mug").at(0);
  const CommandOutcome outcome = Run(
      {"get", "--collection", "demo", id, "--out", Path("back.off"), "--json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(installation_->ReadFile("back.off"),
            installation_->ReadFile("meshes/mug/mug-01.off"));
}

TEST_F(CommandLineTest, ShowsTheGraphOfAShape) {
  const std::string id = ShapesOf("quadruped").at(0);
  const OrderedJson graph =
      Run({"graph", "--collection", "demo", id, "--json"}).Json();
  ASSERT_GE(graph["levels"].size(), 2U);
  const std::string level = graph["levels"][0]["level"];
  const OrderedJson one =
      Run({"graph", "--collection", "demo", id, "--level", level, "--json"})
          .Json();
  ASSERT_EQ(one["levels"].size(), 1U);
  EXPECT_EQ(one["levels"][0], graph["levels"][0]);
  const CommandOutcome wrong =
      Run({"graph", "--collection", "demo", id, "--level", "nonsense"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr(level));
}

TEST_F(CommandLineTest, EvaluatesACollectionByLeavingOneOut) {
  const CommandOutcome outcome =
      Run({"evaluate", "--collection", "demo", "--mode", "global", "--json",
           "--scores", Path("scores.tsv")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const OrderedJson json = outcome.Json();
  EXPECT_EQ(json["queries"], 8);
  for (const char* key : {"nn", "ft", "st", "e", "dcg"}) {
    ASSERT_TRUE(json.contains(key)) << key;
    EXPECT_GE(json[key], 0) << key;
    EXPECT_LE(json[key], 1) << key;
  }
  EXPECT_GE(json["st"], json["ft"]);
  // With one relevant shape a query, nearest neighbour and first tier agree.
  EXPECT_EQ(json["nn"], json["ft"]);
  ASSERT_EQ(json["per_class"].size(), 4U);
  EXPECT_EQ(json["per_class"]["mug"]["queries"], 2);
  EXPECT_EQ(json["matrix"]["classes"].size(), 4U);
  EXPECT_EQ(json["matrix"]["mean_score"][3].size(), 4U);
  const std::string scores = installation_->ReadFile("scores.tsv");
  EXPECT_EQ(std::count(scores.begin(), scores.end(), '\n'), 9);
  EXPECT_EQ(outcome.Json().dump(), json.dump());
}

TEST_F(CommandLineTest, EvaluatesTablesOfQueryFiles) {
  installation_->WriteFile("meshes/q.tsv",
                           "mug/mug-01.off\tmug\tmug/mug-01.off\n"
                           "table/table-02.off\ttable\t-\n");
  for (const std::string mode : {"partial", "global"}) {
    SCOPED_TRACE(mode);
    const CommandOutcome outcome =
        Run({"evaluate", "--collection", "demo", "--mode", mode, "--queries",
             Path("meshes/q.tsv"), "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const OrderedJson json = outcome.Json();
    EXPECT_EQ(json["queries"], 2);
    EXPECT_EQ(json["with_source"], 1);
    EXPECT_EQ(json["source_first"], 1.0);
    EXPECT_EQ(json["source_top5"], 1.0);
    // The second query's own shape is stored and counts.
    EXPECT_EQ(json["per_class"]["table"]["nn"], 1.0);
  }
}

TEST_F(CommandLineTest, DrawsPictures) {
  const std::string a = ShapesOf("quadruped").at(0);
  const std::string b = ShapesOf("quadruped").at(1);
  const Words size = {"--collection", "demo", "--width", "120", "--out"};
  const std::vector<std::pair<std::string, Words>> pictures = {
      {"levels", {a}},
      {"modes", {a}},
      {"match", {a, b}},
      {"match", {Path("meshes/mug/mug-01.off"), Path("meshes/mug/mug-02.off")}},
      {"results", {"--shape", a, "--limit", "3"}},
      {"results", {"--mode", "partial", Path("meshes/mug/mug-01.off")}}};
  for (const auto& [kind, arguments] : pictures) {
    SCOPED_TRACE(kind);
    Words words = {"picture", kind};
    words.insert(words.end(), size.begin(), size.end());
    words.push_back(Path("picture.png"));
    words.insert(words.end(), arguments.begin(), arguments.end());
    installation_->WriteFile("picture.png", "");
    const CommandOutcome outcome = Run(words);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    ExpectPng("picture.png");
  }
}

TEST_F(CommandLineTest, DrawsTheMatrixOfAnEvaluationMadeBefore) {
  const CommandOutcome evaluation =
      Run({"evaluate", "--collection", "demo", "--json"});
  installation_->WriteFile("evaluation.json", evaluation.out);
  const CommandOutcome outcome =
      Run({"picture", "matrix", "--from", Path("evaluation.json"), "--out",
           Path("matrix.png")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  ExpectPng("matrix.png");
}

TEST_F(CommandLineTest, WritesColouredMeshes) {
  const std::string a = ShapesOf("mug").at(0);
  const std::string b = ShapesOf("mug").at(1);
  const CommandOutcome outcome =
      Run({"picture", "ply", "--collection", "demo", a, "--match", b, "--out",
           Path("a.ply"), "--match-out", Path("b.ply")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(installation_->ReadFile("a.ply").starts_with("ply\n"));
  EXPECT_THAT(installation_->ReadFile("b.ply"), HasSubstr("red"));
}

TEST_F(CommandLineTest, SaysWhatIsNotThere) {
  const CommandOutcome collection =
      Run({"search", "--collection", "nowhere", "--shape", "x", "--json"});
  EXPECT_EQ(collection.exit_code, 1);
  EXPECT_EQ(collection.Json()["error"]["code"], "NOT_FOUND");
  EXPECT_THAT(collection.Json()["error"]["reason"].get<std::string>(),
              HasSubstr("NOT_FOUND"));
  const CommandOutcome shape = Run({"get", "--collection", "demo", "absent"});
  EXPECT_EQ(shape.exit_code, 1);
  EXPECT_THAT(shape.err, HasSubstr("SHAPE_NOT_FOUND"));
}

TEST_F(CommandLineTest, DeletesShapesAndCollections) {
  installation_->WriteFile("gone/x.off",
                           installation_->ReadFile("meshes/mug/mug-01.off"));
  installation_->WriteFile("gone/y.off",
                           installation_->ReadFile("meshes/mug/mug-02.off"));
  ASSERT_EQ(Run({"ingest", "--collection", "gone", Path("gone")}).exit_code, 0);
  const OrderedJson list =
      Run({"list", "--collection", "gone", "--json"}).Json();
  const std::string x = list["shapes"][0]["shape"];
  EXPECT_EQ(Run({"delete", "--collection", "gone", x}).exit_code, 0);
  EXPECT_EQ(Run({"delete", "--collection", "gone", x}).exit_code, 1);
  EXPECT_EQ(Run({"delete", "--collection", "gone"}).exit_code, 1);
  EXPECT_EQ(Run({"delete", "--collection", "gone", "--force"}).exit_code, 0);
  EXPECT_EQ(Run({"get", "--collection", "gone"}).exit_code, 1);
}

TEST_F(CommandLineTest, ProbesTheHealthOfTheServer) {
  const CommandOutcome outcome = Run({"health", "--json"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.Json()["status"], "SERVING");
}

TEST_F(CommandLineTest, StopsAnIngestCleanlyOnInterrupt) {
  ASSERT_EQ(Run({"sample", "--out", Path("many"), "--shapes-per-class", "6",
                 "--classes", "mug,table,wrench", "--vertices", "2000"})
                .exit_code,
            0);
  ChildProcess ingest =
      installation_->Start({"ingest", "--collection", "many", "--verbose",
                            "--jobs", "2", Path("many"), "--json"});
  while (ingest.Running() &&
         ingest.Err().find("stored ") == std::string::npos) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ingest.Signal(SIGINT);
  EXPECT_EQ(ingest.Wait(), 130) << ingest.Err();
  const OrderedJson summary = OrderedJson::parse(ingest.Out(), nullptr, false);
  const int64_t ingested = summary["ingested"];
  EXPECT_GE(ingested, 1);
  EXPECT_EQ(ingested + summary["remaining"].get<int64_t>(), 18);
  const OrderedJson list =
      Run({"list", "--collection", "many", "--json"}).Json();
  EXPECT_EQ(static_cast<int64_t>(list["shapes"].size()), ingested);
  const CommandOutcome rest =
      Run({"ingest", "--collection", "many", Path("many"), "--json"});
  EXPECT_EQ(rest.exit_code, 0) << rest.err;
  EXPECT_EQ(rest.Json()["already_stored"], ingested);
}

}  // namespace
}  // namespace argmesh
