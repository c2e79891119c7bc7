// Backing up and restoring with the programs an operator has.
#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>
#include <string>

#include "tests/e2e/installation.h"

namespace argmesh {
namespace {

class SnapshotTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(installation_.StartServer());
    ASSERT_EQ(
        installation_
            .Run({"sample", "--out", Path("meshes"), "--classes", "mug,wrench",
                  "--shapes-per-class", "2", "--vertices", "1500"})
            .exit_code,
        0);
    Ingest("first");
  }

  void Ingest(const std::string& collection) {
    const CommandOutcome ingest = installation_.Run(
        {"ingest", "--collection", collection, Path("meshes")});
    ASSERT_EQ(ingest.exit_code, 0) << ingest.err;
  }
  std::string Path(const std::string& name) const {
    return (installation_.folder() / name).string();
  }
  int Admin(const std::vector<std::string>& words) {
    std::vector<std::string> line = {"admin"};
    line.insert(line.end(), words.begin(), words.end());
    const CommandOutcome outcome = installation_.Run(line);
    EXPECT_TRUE(outcome.exit_code == 0 || !outcome.err.empty());
    return outcome.exit_code;
  }
  void StopServer() {
    installation_.SignalServer(SIGTERM);
    ASSERT_EQ(installation_.WaitForServer(), 0);
  }

  Installation installation_;
};

TEST_F(SnapshotTest, BringsBackWhatWasThere) {
  ASSERT_EQ(Admin({"snapshot", "create", "one"}), 0);
  EXPECT_EQ(Admin({"snapshot", "create", "one"}), 1) << "it is taken";
  ASSERT_EQ(Admin({"snapshot", "download", "one", "--out", Path("one.tar")}),
            0);
  EXPECT_FALSE(std::filesystem::exists(Path("one.tar.part")));
  Ingest("second");
  EXPECT_EQ(Admin({"verify"}), 0);
  StopServer();

  const CommandOutcome restored = installation_.RunServerProgram(
      {"--data", Path("store"), "--restore", Path("one.tar")});
  ASSERT_EQ(restored.exit_code, 0) << restored.err;
  EXPECT_NE(restored.out.find("before-restore-"), std::string::npos);
  ASSERT_TRUE(installation_.StartServer());
  EXPECT_EQ(installation_.Run({"list", "--collection", "second"}).exit_code, 1);
  const CommandOutcome list =
      installation_.Run({"list", "--collection", "first", "--json"});
  EXPECT_EQ(list.exit_code, 0) << list.err;
  EXPECT_EQ(Admin({"verify"}), 0);
  EXPECT_EQ(Admin({"snapshot", "delete", "one"}), 0);
}

TEST_F(SnapshotTest, RefusesADamagedOne) {
  ASSERT_EQ(Admin({"snapshot", "create", "one"}), 0);
  ASSERT_EQ(Admin({"snapshot", "download", "one", "--out", Path("one.tar")}),
            0);
  std::string bytes = installation_.ReadFile("one.tar");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  installation_.WriteFile("one.tar", bytes);
  StopServer();
  const CommandOutcome restored = installation_.RunServerProgram(
      {"--data", Path("store"), "--restore", Path("one.tar")});
  EXPECT_EQ(restored.exit_code, 1);
  ASSERT_TRUE(installation_.StartServer());
  EXPECT_EQ(installation_.Run({"list", "--collection", "first"}).exit_code, 0);
}

TEST_F(SnapshotTest, IsNotRestoredUnderARunningServer) {
  ASSERT_EQ(Admin({"snapshot", "create", "one"}), 0);
  const CommandOutcome restored = installation_.RunServerProgram(
      {"--data", Path("store"), "--restore", Path("store/snapshots/one.tar")});
  EXPECT_EQ(restored.exit_code, 1);
  EXPECT_NE(restored.err.find("in use"), std::string::npos) << restored.err;
}

TEST_F(SnapshotTest, VerificationNamesADamagedMesh) {
  StopServer();
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(Path("store/blobs"))) {
    if (entry.is_regular_file()) {
      std::filesystem::resize_file(entry.path(), 10);
      break;
    }
  }
  ASSERT_TRUE(installation_.StartServer());
  const CommandOutcome verify =
      installation_.Run({"admin", "verify", "--json"});
  EXPECT_EQ(verify.exit_code, 1);
  EXPECT_EQ(verify.Json()["findings"], 1) << verify.out;
}

}  // namespace
}  // namespace argmesh
