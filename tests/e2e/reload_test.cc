// A server with keys that is told to read its options again.
#include <gtest/gtest.h>
#include <signal.h>

#include <map>
#include <string>
#include <vector>

#include "tests/e2e/installation.h"

namespace argmesh {
namespace {

class ReloadTest : public testing::Test {
 protected:
  std::string Path(const std::string& name) const {
    return (installation_.folder() / name).string();
  }

  // Makes a key and leaves its text in the file ID.key.
  void MakeKey(const std::string& id, const std::string& role) {
    const CommandOutcome made = installation_.Run(
        {"keys", "create", "--file", Path("keys.json"), id, "--role", role});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    installation_.WriteFile(id + ".key", made.out);
  }

  CommandOutcome InfoAs(const std::string& id) {
    return installation_.Run({"info", "--key-file", Path(id + ".key")});
  }

  bool Reload(const std::string& answer) {
    installation_.SignalServer(SIGHUP);
    return installation_.WaitForLog(answer, ++reloads_[answer]);
  }

  // `argmesh keys limit` with these words, which then count.
  void Limit(const std::string& id, const std::vector<std::string>& limits) {
    std::vector<std::string> words = {"keys", "limit", "--file",
                                      Path("keys.json"), id};
    words.insert(words.end(), limits.begin(), limits.end());
    const CommandOutcome limited = installation_.Run(words);
    ASSERT_EQ(limited.exit_code, 0) << limited.err;
    ASSERT_TRUE(Reload("\"msg\":\"reloaded\""));
  }

  void ExpectLimited(const std::string& id) {
    const CommandOutcome info =
        installation_.Run({"info", "--json", "--key-file", Path(id + ".key")});
    EXPECT_EQ(info.exit_code, 1);
    EXPECT_EQ(info.Json()["error"]["code"], "RESOURCE_EXHAUSTED") << info.out;
    EXPECT_EQ(info.Json()["error"]["reason"], "KEY_LIMIT_EXCEEDED") << info.out;
  }

  Installation installation_;
  std::map<std::string, int> reloads_;  // by the server's answer
};

TEST_F(ReloadTest, LetsKeysInAndOut) {
  MakeKey("ops", "admin");
  ASSERT_TRUE(installation_.StartServer({"--keys", Path("keys.json")}));
  const CommandOutcome nobody = installation_.Run({"info"});
  EXPECT_EQ(nobody.exit_code, 1);
  EXPECT_NE(nobody.err.find("[KEY_MISSING]"), std::string::npos) << nobody.err;
  EXPECT_EQ(InfoAs("ops").exit_code, 0);
  EXPECT_EQ(installation_.Run({"health"}).exit_code, 0) << "probes need no key";

  MakeKey("ci", "read");
  EXPECT_NE(InfoAs("ci").err.find("[KEY_INVALID]"), std::string::npos);
  const CommandOutcome revoked =
      installation_.Run({"keys", "revoke", "--file", Path("keys.json"), "ops"});
  ASSERT_EQ(revoked.exit_code, 0) << revoked.err;
  ASSERT_TRUE(Reload("\"msg\":\"reloaded\""));
  EXPECT_EQ(InfoAs("ci").exit_code, 0);
  EXPECT_NE(InfoAs("ops").err.find("[KEY_INVALID]"), std::string::npos);
  const CommandOutcome denied = installation_.Run(
      {"delete", "--collection", "parts", "--key-file", Path("ci.key")});
  EXPECT_NE(denied.err.find("[PERMISSION_DENIED]"), std::string::npos)
      << denied.err;
}

// The rate is so low that no call is given back while the test runs.
TEST_F(ReloadTest, LimitsOneKeyUntilItsLimitIsTakenAway) {
  MakeKey("ci", "read");
  MakeKey("ops", "admin");
  ASSERT_TRUE(installation_.StartServer({"--keys", Path("keys.json")}));
  for (int i = 0; i < 4; ++i) EXPECT_EQ(InfoAs("ci").exit_code, 0);

  Limit("ci", {"--rate", "0.0001", "--burst", "2"});
  EXPECT_EQ(InfoAs("ci").exit_code, 0);
  EXPECT_EQ(InfoAs("ci").exit_code, 0);
  ExpectLimited("ci");
  ExpectLimited("ci");
  for (int i = 0; i < 4; ++i) EXPECT_EQ(InfoAs("ops").exit_code, 0);
  ASSERT_TRUE(Reload("\"msg\":\"reloaded\""));
  ExpectLimited("ci");  // a reload is no new burst

  Limit("ci", {});
  for (int i = 0; i < 4; ++i) EXPECT_EQ(InfoAs("ci").exit_code, 0);
}

TEST_F(ReloadTest, KeepsTheKeysWhileTheFileIsBad) {
  MakeKey("ops", "admin");
  ASSERT_TRUE(installation_.StartServer({"--keys", Path("keys.json")}));
  installation_.WriteFile("keys.json", "{\"keys\": [{}]}");
  ASSERT_TRUE(Reload("\"msg\":\"not reloaded\""));
  EXPECT_EQ(InfoAs("ops").exit_code, 0);
}

TEST_F(ReloadTest, TakesLevelAndLimitsAndNamesWhatNeedsARestart) {
  installation_.WriteFile("argmeshd.toml", "log-level=\"info\"\n");
  ASSERT_TRUE(installation_.StartServer({"--config", Path("argmeshd.toml")}));
  ASSERT_EQ(installation_.Run({"info"}).exit_code, 0);
  EXPECT_EQ(installation_.ServerLog().find("\"debug\""), std::string::npos);
  installation_.WriteFile("argmeshd.toml",
                          "log-level=\"debug\"\nmax-inflight-searches=3\n"
                          "threads=7\n");
  ASSERT_TRUE(Reload("\"msg\":\"reloaded\""));
  const CommandOutcome info = installation_.Run({"info", "--json"});
  ASSERT_EQ(info.exit_code, 0) << info.err;
  EXPECT_NE(info.out.find("\"max_inflight_searches\": 3"), std::string::npos)
      << info.out;
  EXPECT_TRUE(installation_.WaitForLog("AdminService.GetServerInfo"));
  EXPECT_NE(installation_.ServerLog().find("\"options\":\"threads\""),
            std::string::npos)
      << installation_.ServerLog();
}

TEST_F(ReloadTest, GoesOnWhenTheOptionsAreWrong) {
  installation_.WriteFile("argmeshd.toml", "log-level=\"info\"\n");
  ASSERT_TRUE(installation_.StartServer({"--config", Path("argmeshd.toml")}));
  installation_.WriteFile("argmeshd.toml", "log-level=\"loud\"\n");
  ASSERT_TRUE(Reload("\"msg\":\"not reloaded\""));
  EXPECT_EQ(installation_.Run({"info"}).exit_code, 0);
}

TEST_F(ReloadTest, GoesOnWithRotatedLogFiles) {
  ASSERT_TRUE(installation_.StartServer({"--audit-log", Path("audit")}));
  const std::vector<std::string> remove = {"delete", "--collection", "parts"};
  EXPECT_EQ(installation_.Run(remove).exit_code, 1);
  std::filesystem::rename(Path("audit"), Path("audit.1"));
  ASSERT_TRUE(Reload("\"msg\":\"reloaded\""));
  EXPECT_EQ(installation_.Run(remove).exit_code, 1);
  for (const char* name : {"audit", "audit.1"}) {
    EXPECT_NE(installation_.ReadFile(name).find("COLLECTION_NOT_FOUND"),
              std::string::npos)
        << name;
  }
}

}  // namespace
}  // namespace argmesh
