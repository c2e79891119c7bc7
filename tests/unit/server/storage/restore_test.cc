#include "server/storage/restore.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "server/engine/error_reason.h"
#include "tests/support/environment_number.h"
#include "tests/support/temporary_directory.h"
#include "tests/unit/server/storage/stored_samples.h"

namespace argmesh {
namespace {

namespace fs = std::filesystem;

class RestoreTest : public ::testing::Test {
 protected:
  // A snapshot with three cups; afterwards one is gone and two knives come.
  RestoreTest() : samples_(folder_.path() / "data") {
    samples_.AddCollection("cups");
    for (uint64_t seed = 1; seed <= 3; ++seed) {
      samples_.AddShape("cups", "cup-" + std::to_string(seed), seed);
    }
    then_ = samples_.Contents();
    EXPECT_TRUE(samples_.snapshots().CreateSnapshot("one", {}).ok());
    fs::copy_file(samples_.path() / "snapshots" / "one.tar", snapshot_);
    EXPECT_TRUE(samples_.catalog()
                    .DeleteShape({"cups", "cup-1", /*etag=*/"", {}})
                    .ok());
    samples_.AddCollection("knives");
    samples_.AddShape("knives", "knife-1", 11);
    samples_.AddShape("knives", "knife-2", 12);
    now_ = samples_.Contents();
    samples_.Close();
  }

  absl::StatusOr<RestoreReport> RestoreTo(const fs::path& data) const {
    const auto directory = DataDirectory::Open(
        data, {.min_free_bytes = 0, .allow_network_file_system = true});
    EXPECT_TRUE(directory.ok()) << directory.status();
    return RestoreSnapshot(snapshot_, **directory);
  }

  std::string SnapshotBytes() const {
    std::ifstream in(snapshot_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void StoreSnapshot(const std::string& bytes) const {
    std::ofstream(snapshot_, std::ios::binary | std::ios::trunc) << bytes;
  }

  const TemporaryDirectory folder_;
  const fs::path snapshot_ = folder_.path() / "snapshot.tar";
  StoredSamples samples_;
  std::vector<std::string> then_;
  std::vector<std::string> now_;
};

TEST_F(RestoreTest, BringsASnapshotToAnEmptyDirectory) {
  const fs::path data = folder_.path() / "other";
  const auto report = RestoreTo(data);
  ASSERT_TRUE(report.ok()) << report.status();
  EXPECT_EQ(report->meshes, 3);
  EXPECT_TRUE(report->kept.empty()) << report->kept;
  StoredSamples restored(data);
  EXPECT_EQ(restored.Contents(), then_);
  EXPECT_EQ(restored.snapshots().Verify("", {})->findings, 0);
  restored.AddShape("cups", "cup-4", 4);  // and it goes on
  EXPECT_EQ(restored.Contents().size(), 4U);
}

TEST_F(RestoreTest, KeepsWhatWasThereBefore) {
  const auto report = RestoreTo(samples_.path());
  ASSERT_TRUE(report.ok()) << report.status();
  {
    StoredSamples restored(samples_.path());
    EXPECT_EQ(restored.Contents(), then_);
  }
  ASSERT_FALSE(report->kept.empty());
  StoredSamples before(report->kept);
  EXPECT_EQ(before.Contents(), now_);
}

TEST_F(RestoreTest, RefusesEveryDamagedSnapshotAndLeavesTheDataAlone) {
  const std::string bytes = SnapshotBytes();
  const uint64_t seed = 11;
  Random random(seed);
  const uint64_t rounds = EnvironmentNumber("ARGMESH_DAMAGED_SNAPSHOTS", 200);
  for (uint64_t round = 0; round < rounds; ++round) {
    std::string damaged = bytes;
    const size_t at = random.Below(bytes.size());
    if (round % 4 == 3) {
      damaged.resize(at);
    } else {
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << random.Below(8)));
    }
    StoreSnapshot(damaged);
    const auto report = RestoreTo(samples_.path());
    ASSERT_FALSE(report.ok())
        << "seed " << seed << ", round " << round << ", byte " << at;
  }
  EXPECT_FALSE(fs::exists(samples_.path() / "restoring"));
  samples_.Open();
  EXPECT_EQ(samples_.Contents(), now_);
  std::printf("measured: %s of as many damaged snapshots refused, seed 11\n",
              std::to_string(rounds).c_str());
}

TEST_F(RestoreTest, RefusesWhatIsNoSnapshot) {
  StoreSnapshot("something else");
  EXPECT_EQ(ReasonOf(RestoreTo(samples_.path()).status()),
            ErrorReason::kStoredDataDamaged);
  fs::remove(snapshot_);
  EXPECT_FALSE(RestoreTo(samples_.path()).ok());
}

TEST_F(RestoreTest, RefusesADirectoryThatIsInUse) {
  samples_.Open();
  const auto second = DataDirectory::Open(samples_.path());
  EXPECT_EQ(second.status().code(), absl::StatusCode::kFailedPrecondition);
}

TEST_F(RestoreTest, IsUndoneByTheNextStartWhenItWasNotComplete) {
  fs::create_directories(samples_.path() / "restoring" / "blobs");
  std::ofstream(samples_.path() / "restoring" / "catalog.db") << "half";
  samples_.Open();
  EXPECT_EQ(samples_.Contents(), now_);
  EXPECT_FALSE(fs::exists(samples_.path() / "restoring"));
}

// After each of its renames the process may be gone.
TEST_F(RestoreTest, IsFinishedByTheNextStartWhereverItWasInterrupted) {
  const std::vector<std::pair<std::string, std::string>> renames = {
      {"clean", "kept/clean"},
      {"catalog.db", "kept/catalog.db"},
      {"restoring/catalog.db", "catalog.db"},
      {"blobs", "kept/blobs"},
      {"restoring/blobs", "blobs"}};
  for (size_t done = 0; done <= renames.size(); ++done) {
    const fs::path data = folder_.path() / ("copy-" + std::to_string(done));
    fs::copy(samples_.path(), data, fs::copy_options::recursive);
    const fs::path restoring = data / "restoring";
    fs::create_directory(restoring);
    const std::string unpack = "tar -xf " + snapshot_.string() + " -C " +
                               restoring.string() + " && rm " +
                               restoring.string() + "/seal " +
                               restoring.string() + "/argmesh-snapshot";
    ASSERT_EQ(std::system(unpack.c_str()), 0);
    std::ofstream(restoring / "complete") << "kept\n";
    if (done > 0) fs::create_directory(data / "kept");
    for (size_t i = 0; i < done; ++i) {
      fs::rename(data / renames[i].first, data / renames[i].second);
    }
    {
      StoredSamples restored(data);
      EXPECT_EQ(restored.Contents(), then_) << done << " renames done";
      EXPECT_FALSE(fs::exists(restoring));
    }
    StoredSamples before(data / "kept");
    EXPECT_EQ(before.Contents(), now_) << done << " renames done";
  }
}

}  // namespace
}  // namespace argmesh
