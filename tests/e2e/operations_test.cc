// Commands that follow an operation of the server, import and reindex, and
// those that list and cancel operations.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sqlite3.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/e2e/installation.h"

namespace argmesh {
namespace {

using testing::HasSubstr;

class OperationsTest : public testing::Test {
 protected:
  void SetUp() override {
    const CommandOutcome sample = installation_.Run(
        {"sample", "--out", Path("meshes"), "--shapes-per-class", "2",
         "--classes", "mug,wrench", "--vertices", "1500"});
    ASSERT_EQ(sample.exit_code, 0) << sample.err;
    ASSERT_TRUE(installation_.StartServer(
        {"--import-root", Path("meshes"), "--log-level", "debug"}));
  }

  std::string Path(const std::string& relative) const {
    return (installation_.folder() / relative).string();
  }

  int64_t Unusable() {
    return installation_
        .Run({"search", "--collection", "c", "--limit", "10", "--json",
              Path("meshes/mug/mug-01.off")})
        .Json()["stats"]["shapes_unusable"];
  }

  Installation installation_;
};

TEST_F(OperationsTest, ImportStoresWhatIngestWouldUnderTheSameIds) {
  const CommandOutcome import =
      installation_.Run({"import", "--collection", "c", "--json"});
  ASSERT_EQ(import.exit_code, 0) << import.err;
  EXPECT_EQ(import.Json()["imported"], 4);
  EXPECT_EQ(import.Json()["failed"], 0);
  const CommandOutcome ingest = installation_.Run(
      {"ingest", "--collection", "c", "--json", Path("meshes")});
  EXPECT_EQ(ingest.Json()["ingested"], 0);
  EXPECT_EQ(ingest.Json()["already_stored"], 4);
}

TEST_F(OperationsTest, ImportNamesFilesThatFailedAndGoesOnWithTheRest) {
  installation_.WriteFile("meshes/mug/bad.off", "OFF\n1 1 0\n");
  const CommandOutcome import =
      installation_.Run({"import", "--collection", "c", "--json", "mug"});
  EXPECT_EQ(import.exit_code, 1);
  EXPECT_EQ(import.Json()["imported"], 2);
  ASSERT_EQ(import.Json()["failures"].size(), 1U);
  EXPECT_EQ(import.Json()["failures"][0]["path"], "bad.off");
  EXPECT_EQ(import.Json()["failures"][0]["reason"], "MESH_MALFORMED");
  EXPECT_THAT(import.err, HasSubstr("failed bad.off"));
  const CommandOutcome outside =
      installation_.Run({"import", "--collection", "c", "--json", ".."});
  EXPECT_EQ(outside.exit_code, 1);
  EXPECT_EQ(outside.Json()["error"]["reason"], "FILE_UNREADABLE");
}

TEST_F(OperationsTest, ReindexMakesShapesOfAnotherVersionSearchable) {
  ASSERT_EQ(installation_.Run({"import", "--collection", "c"}).exit_code, 0);
  ASSERT_EQ(Unusable(), 0);
  installation_.SignalServer(SIGTERM);
  ASSERT_EQ(installation_.WaitForServer(), 0);
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open(Path("store/catalog.db").c_str(), &db), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(db,
                         "UPDATE graph SET algorithm_version = "
                         "algorithm_version - 1",
                         nullptr, nullptr, nullptr),
            SQLITE_OK);
  sqlite3_close(db);
  ASSERT_TRUE(installation_.StartServer());
  EXPECT_EQ(Unusable(), 4);
  const CommandOutcome reindex = installation_.Run({"reindex", "c", "--json"});
  ASSERT_EQ(reindex.exit_code, 0) << reindex.err;
  EXPECT_EQ(reindex.Json()["reindexed"], 4);
  EXPECT_EQ(reindex.Json()["failed"], 0);
  EXPECT_EQ(Unusable(), 0);
}

TEST_F(OperationsTest, ReindexIsCancelledByCtrlC) {
  ASSERT_EQ(installation_.Run({"import", "--collection", "c"}).exit_code, 0);
  // Far more samples than can be described before the signal comes.
  const std::vector<std::string> words = {"reindex", "c", "--vertex-budget",
                                          "60000"};
  ChildProcess reindex = installation_.Start(words);
  ASSERT_TRUE(installation_.WaitForLog("CollectionService.ReindexCollection"));
  reindex.Signal(SIGINT);
  EXPECT_EQ(reindex.Wait(), 130) << reindex.Err();
  EXPECT_THAT(reindex.Err(), HasSubstr("stopping"));
  const auto budget = [this] {
    return installation_.Run({"list", "--json"})
        .Json()["collections"][0]["vertex_budget"]
        .get<int>();
  };
  EXPECT_EQ(budget(), 3000);
  const CommandOutcome smaller =
      installation_.Run({"reindex", "c", "--vertex-budget", "700"});
  EXPECT_EQ(smaller.exit_code, 0) << smaller.err;
  EXPECT_EQ(budget(), 700);
}

TEST_F(OperationsTest, AreListedAndCancelledByOthers) {
  ASSERT_EQ(installation_.Run({"import", "--collection", "c"}).exit_code, 0);
  const auto list = [this] {
    std::map<std::string, nlohmann::ordered_json> by_method;
    const CommandOutcome outcome =
        installation_.Run({"operations", "list", "--json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const nlohmann::ordered_json json = outcome.Json();
    for (const auto& operation : json["operations"]) {
      by_method[operation["method"]] = operation;
    }
    return by_method;
  };
  auto operations = list();
  ASSERT_EQ(operations.size(), 1U);
  const auto import = operations["IngestService.ImportShapes"];
  EXPECT_EQ(import["state"], "done");
  EXPECT_EQ(import["resource"], "collections/c");
  EXPECT_EQ(import["items_done"], 4);

  const std::string method = "CollectionService.ReindexCollection";
  ChildProcess reindex =
      installation_.Start({"reindex", "c", "--vertex-budget", "60000"});
  ASSERT_TRUE(installation_.WaitForLog(method));
  EXPECT_EQ(list()[method]["state"], "running");
  const std::string id = list()[method]["operation"];
  const CommandOutcome cancel = installation_.Run({"operations", "cancel", id});
  EXPECT_EQ(cancel.exit_code, 0) << cancel.err;
  EXPECT_NE(reindex.Wait(), 0);
  EXPECT_EQ(list()[method]["state"], "cancelled");
  EXPECT_THAT(installation_.Run({"operations", "list"}).out,
              HasSubstr("cancelled"));

  const CommandOutcome none = installation_.Run(
      {"operations", "cancel", "00000000-0000-4000-8000-000000000000"});
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_THAT(none.err, HasSubstr("OPERATION_NOT_FOUND"));
}

TEST_F(OperationsTest, AreRememberedWhenTheServerIsKilled) {
  ASSERT_EQ(installation_.Run({"import", "--collection", "c"}).exit_code, 0);
  ChildProcess reindex =
      installation_.Start({"reindex", "c", "--vertex-budget", "60000"});
  ASSERT_TRUE(installation_.WaitForLog("CollectionService.ReindexCollection"));
  installation_.SignalServer(SIGKILL);
  installation_.WaitForServer();
  reindex.Signal(SIGINT);
  reindex.Wait();
  ASSERT_TRUE(installation_.StartServer());
  const CommandOutcome list =
      installation_.Run({"operations", "list", "--json"});
  ASSERT_EQ(list.exit_code, 0) << list.err;
  std::map<std::string, std::string> states;
  const nlohmann::ordered_json json = list.Json();
  for (const auto& operation : json["operations"]) {
    states[operation["method"]] = operation["state"];
  }
  EXPECT_EQ(states["IngestService.ImportShapes"], "done");
  EXPECT_EQ(states["CollectionService.ReindexCollection"], "cancelled");
  EXPECT_THAT(list.out, HasSubstr("the server ended before the operation"));
}

TEST_F(OperationsTest, ReindexGivesACollectionOtherSettings) {
  ASSERT_EQ(installation_.Run({"import", "--collection", "c"}).exit_code, 0);
  const std::string shape =
      installation_.Run({"list", "--collection", "c", "--json"})
          .Json()["shapes"][0]["shape"];
  const auto levels = [&] {
    const CommandOutcome graph =
        installation_.Run({"graph", "--collection", "c", shape, "--json"});
    EXPECT_EQ(graph.exit_code, 0) << graph.err;
    return graph.Json()["levels"].dump();
  };
  const std::string before = levels();
  const CommandOutcome reindex =
      installation_.Run({"reindex", "c", "--vertex-budget", "700",
                         "--uniform-cells", "5", "--json"});
  ASSERT_EQ(reindex.exit_code, 0) << reindex.err;
  EXPECT_EQ(reindex.Json()["reindexed"], 4);
  EXPECT_EQ(reindex.Json()["failed"], 0);
  EXPECT_EQ(reindex.Json()["decomposition"], "biharmonic");
  EXPECT_EQ(reindex.Json()["vertex_budget"], 700);
  EXPECT_EQ(reindex.Json()["uniform_cells"], 5);
  EXPECT_EQ(reindex.Json()["generation"], 5);
  EXPECT_NE(levels(), before);
  EXPECT_EQ(Unusable(), 0);
  const CommandOutcome again =
      installation_.Run({"reindex", "c", "--decomposition", "voronoi"});
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.out,
              HasSubstr("voronoi, vertex budget 700, uniform cells 5"));
  EXPECT_EQ(
      installation_.Run({"reindex", "c", "--vertex-budget", "99"}).exit_code,
      2);
}

}  // namespace
}  // namespace argmesh
