// A server killed while several clients ingest: what was acknowledged is there
// when it is back, what is there is whole, and the ingests go on.
//
// ARGMESH_KILL_ROUNDS rounds, 4 when not set, of ARGMESH_KILL_CLIENTS clients,
// 4 when not set.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "core/base/random.h"
#include "tests/e2e/installation.h"
#include "tests/support/environment_number.h"

namespace argmesh {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr int kShapes = 4;  // of one client

uint64_t Rounds() { return EnvironmentNumber("ARGMESH_KILL_ROUNDS", 4); }
uint64_t Clients() { return EnvironmentNumber("ARGMESH_KILL_CLIENTS", 4); }

// The ids in the lines "stored ID PATH".
std::set<std::string> Acknowledged(const ChildProcess& ingest) {
  std::set<std::string> ids;
  std::istringstream lines(ingest.Err());
  std::string line;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string verb;
    std::string id;
    // A line that is still being written does not count.
    if (words >> verb >> id && verb == "stored" && !lines.eof()) ids.insert(id);
  }
  return ids;
}

// One client, which fills a collection of its own.
struct Ingesting {
  std::string collection;
  ChildProcess process;
};

size_t AcknowledgedOf(const std::vector<Ingesting>& clients) {
  size_t count = 0;
  for (const Ingesting& client : clients) {
    count += Acknowledged(client.process).size();
  }
  return count;
}

bool AnyRuns(std::vector<Ingesting>& clients) {
  return std::any_of(clients.begin(), clients.end(), [](Ingesting& client) {
    return client.process.Running();
  });
}

class KillTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(installation_.StartServer());
    const CommandOutcome sample =
        installation_.Run({"sample", "--out", Meshes(), "--shapes-per-class",
                           std::to_string(kShapes / 2), "--classes",
                           "mug,wrench", "--vertices", "1500"});
    ASSERT_EQ(sample.exit_code, 0) << sample.err;
  }

  std::string Meshes() const {
    return (installation_.folder() / "meshes").string();
  }

  ChildProcess StartIngest(const std::string& collection) {
    return installation_.Start(
        {"ingest", "--collection", collection, "--verbose", Meshes()});
  }

  std::set<std::string> Stored(const std::string& collection) {
    std::set<std::string> ids;
    const CommandOutcome list =
        installation_.Run({"list", "--collection", collection, "--json"});
    if (list.exit_code != 0) return ids;
    const OrderedJson json = list.Json();
    for (const auto& shape : json["shapes"]) {
      EXPECT_EQ(shape["state"], "active");
      ids.insert(shape["shape"].get<std::string>());
    }
    return ids;
  }

  // Every listed shape has a graph, its file, and is found by a search.
  void ExpectWhole(const std::string& collection,
                   const std::set<std::string>& ids) {
    const std::string file = (installation_.folder() / "mesh.off").string();
    for (const std::string& id : ids) {
      EXPECT_EQ(installation_.Run({"graph", "--collection", collection, id})
                    .exit_code,
                0)
          << id;
      EXPECT_EQ(installation_
                    .Run({"get", "--collection", collection, id, "--out", file})
                    .exit_code,
                0)
          << id;
    }
    if (ids.empty()) return;
    const CommandOutcome search = installation_.Run(
        {"search", "--collection", collection, "--shape", *ids.begin(),
         "--include-self", "--limit", "100", "--json"});
    EXPECT_EQ(search.Json()["matches"].size(), ids.size()) << search.err;
  }

  // Kills the server once `count` shapes are acknowledged and `delay` passed.
  void KillServerAfter(std::vector<Ingesting>& clients, size_t count,
                       std::chrono::milliseconds delay) {
    while (AnyRuns(clients) && AcknowledgedOf(clients) < count) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    std::this_thread::sleep_for(delay);
    installation_.SignalServer(SIGKILL);
    installation_.WaitForServer();
  }

  // Of one client, once the server is back.
  void ExpectNothingLost(Ingesting& client, bool client_survives) {
    SCOPED_TRACE(client.collection);
    if (client_survives) {
      // It comes back by itself and stores the rest.
      EXPECT_EQ(client.process.Wait(), 0) << client.process.Err();
      EXPECT_EQ(Stored(client.collection).size(), size_t{kShapes});
    }
    const std::set<std::string> stored = Stored(client.collection);
    for (const std::string& id : Acknowledged(client.process)) {
      EXPECT_TRUE(stored.contains(id)) << id << " was acknowledged";
    }
    ExpectWhole(client.collection, stored);
    const CommandOutcome again = installation_.Run(
        {"ingest", "--collection", client.collection, Meshes(), "--json"});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(again.Json()["already_stored"], stored.size());
    EXPECT_EQ(Stored(client.collection).size(), size_t{kShapes});
  }

  Installation installation_;
};

TEST_F(KillTest, LosesNothingThatWasAcknowledged) {
  constexpr uint64_t kSeed = 7;
  Random random(kSeed);
  size_t acknowledged_shapes = 0;
  for (uint64_t round = 0; round < Rounds(); ++round) {
    SCOPED_TRACE("round " + std::to_string(round) + ", seed 7");
    const bool clients_survive = round % 2 == 1;
    std::vector<Ingesting> clients;
    for (uint64_t i = 0; i < Clients(); ++i) {
      const std::string collection =
          "round-" + std::to_string(round) + "-" + std::to_string(i);
      clients.push_back({collection, StartIngest(collection)});
    }
    KillServerAfter(clients, random.Below(kShapes * Clients()),
                    std::chrono::milliseconds(random.Below(150)));
    for (Ingesting& client : clients) {
      if (clients_survive) continue;
      client.process.Signal(SIGKILL);
      client.process.Wait();
    }
    acknowledged_shapes += AcknowledgedOf(clients);
    ASSERT_TRUE(installation_.StartServer()) << installation_.ServerLog();
    for (Ingesting& client : clients) {
      ExpectNothingLost(client, clients_survive);
    }
    ASSERT_TRUE(installation_.ServerRuns()) << installation_.ServerLog();
  }
  std::printf(
      "measured: %s kills under %s clients, %zu shapes acknowledged "
      "before: %s\n",
      std::to_string(Rounds()).c_str(), std::to_string(Clients()).c_str(),
      acknowledged_shapes, HasFailure() ? "failures" : "0 lost, 0 half there");
}

TEST_F(KillTest, ACallReachesAServerThatComesBackMeanwhile) {
  installation_.SignalServer(SIGKILL);
  installation_.WaitForServer();
  ChildProcess list = installation_.Start({"list", "--json"});
  // Past its first attempts, which find no server.
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  ASSERT_TRUE(installation_.StartServer()) << installation_.ServerLog();
  EXPECT_EQ(list.Wait(), 0) << list.Err();
}

TEST_F(KillTest, AnswersTheSameAfterARestart) {
  ASSERT_EQ(StartIngest("kept").Wait(), 0);
  const std::string id = *Stored("kept").begin();
  const std::vector<std::string> search = {
      "search", "--collection", "kept", "--shape", id, "--json"};
  const OrderedJson before = installation_.Run(search).Json()["matches"];
  installation_.SignalServer(SIGTERM);
  EXPECT_EQ(installation_.WaitForServer(), 0);
  ASSERT_TRUE(installation_.StartServer());
  const OrderedJson after = installation_.Run(search).Json()["matches"];
  EXPECT_EQ(before.size(), static_cast<size_t>(kShapes - 1));
  EXPECT_EQ(before, after);
}

}  // namespace
}  // namespace argmesh
