#include "tests/reliability/simulated_disk.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <set>

#include "tests/support/temporary_directory.h"

namespace argmesh {
namespace {

using Loss = SimulatedDisk::Loss;

// What this process does below a folder, on a simulated disk.
class SimulatedDiskTest : public testing::Test, private FileCallObserver {
 protected:
  int Before(const FileCall& call) override {
    return call.path.ends_with("forbidden") ? EIO : 0;
  }
  void After(const FileCall& call) override { disk_.Apply(call); }

  std::string Path(const std::string& name) const {
    return (root_ / name).string();
  }

  void Write(const std::string& name, const std::string& bytes, bool synced) {
    const int file = open(Path(name).c_str(), O_WRONLY | O_CREAT, 0600);
    ASSERT_GE(file, 0);
    ASSERT_EQ(write(file, bytes.data(), bytes.size()),
              static_cast<ssize_t>(bytes.size()));
    if (synced) {
      ASSERT_EQ(fsync(file), 0);
    }
    close(file);
  }

  void SyncFolder() {
    const int folder = open(root_.c_str(), O_RDONLY | O_DIRECTORY);
    ASSERT_EQ(fsync(folder), 0);
    close(folder);
  }

  DiskImage Image(Loss loss) {
    return disk_.ImageAfterPowerLoss(loss, random_);
  }

  const TemporaryDirectory folder_;
  const std::filesystem::path root_ =
      std::filesystem::canonical(folder_.path());
  SimulatedDisk disk_{root_};
  Random random_{1};
  const FileCallObservation observation_{root_, this};
};

TEST_F(SimulatedDiskTest, KeepsWhatWasSynced) {
  Write("file", "bytes", true);
  SyncFolder();
  for (const Loss loss : {Loss::kEverything, Loss::kWholeWrites, Loss::kSectors,
                          Loss::kNothing}) {
    const DiskImage image = Image(loss);
    EXPECT_EQ(image.files,
              (std::map<std::string, std::string>{{"file", "bytes"}}));
  }
}

TEST_F(SimulatedDiskTest, LosesBytesThatWereNotSynced) {
  Write("file", "bytes", false);
  SyncFolder();
  EXPECT_EQ(Image(Loss::kEverything).files.at("file"), "");
  EXPECT_EQ(Image(Loss::kNothing).files.at("file"), "bytes");
}

TEST_F(SimulatedDiskTest, LosesNamesWhoseFolderWasNotSynced) {
  Write("file", "bytes", true);
  EXPECT_TRUE(Image(Loss::kEverything).files.empty());
  SyncFolder();
  ASSERT_EQ(rename(Path("file").c_str(), Path("other").c_str()), 0);
  EXPECT_TRUE(Image(Loss::kEverything).files.contains("file"));
  EXPECT_TRUE(Image(Loss::kNothing).files.contains("other"));
  ASSERT_EQ(std::remove(Path("other").c_str()), 0);
  EXPECT_TRUE(Image(Loss::kEverything).files.contains("file"));
  EXPECT_TRUE(Image(Loss::kNothing).files.empty());
}

TEST_F(SimulatedDiskTest, TearsWritesBetweenSectors) {
  Write("file", std::string(1024, 'a'), true);
  SyncFolder();
  Write("file", std::string(1024, 'b'), false);
  std::set<std::string> seen;
  for (int i = 0; i < 200; ++i) {
    const std::string bytes = Image(Loss::kSectors).files.at("file");
    ASSERT_EQ(bytes.size(), 1024u);
    seen.insert({bytes[0], bytes[511], bytes[512], bytes[1023]});
  }
  for (const char* torn : {"aaaa", "aabb", "bbaa", "bbbb"}) {
    EXPECT_TRUE(seen.contains(torn)) << torn;
  }
  EXPECT_TRUE(seen.contains("baaa")) << "torn within a sector";
  EXPECT_FALSE(seen.contains("abaa")) << "the end before the beginning";
}

TEST_F(SimulatedDiskTest, CutsAFileThatWasTruncated) {
  Write("file", std::string(1024, 'a'), true);
  SyncFolder();
  const int file = open(Path("file").c_str(), O_WRONLY | O_TRUNC);
  ASSERT_GE(file, 0);
  close(file);
  EXPECT_EQ(Image(Loss::kNothing).files.at("file"), "");
  EXPECT_EQ(Image(Loss::kEverything).files.at("file"), std::string(1024, 'a'));
}

TEST_F(SimulatedDiskTest, ACallThatIsMadeToFailChangesNothing) {
  EXPECT_EQ(open(Path("forbidden").c_str(), O_WRONLY | O_CREAT, 0600), -1);
  EXPECT_EQ(errno, EIO);
  EXPECT_FALSE(std::filesystem::exists(Path("forbidden")));
}

}  // namespace
}  // namespace argmesh
