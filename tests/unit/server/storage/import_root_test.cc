#include "server/storage/import_root.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "server/engine/error_reason.h"
#include "tests/support/status_matchers.h"
#include "tests/support/temporary_directory.h"

namespace argmesh {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ImportRootTest : public ::testing::Test {
 protected:
  void SetUp() override {
    Write("root/a.off", "a");
    Write("root/cups/b.STL", "bb");
    Write("root/cups/deep/c.ply", "ccc");
    Write("root/cups/notes.txt", "no mesh");
    Write("root/.hidden/d.off", "hidden");
    Write("root/cups/.e.off", "hidden");
    Write("secret.off", "secret");
    absl::StatusOr<std::unique_ptr<ImportRoot>> root =
        ImportRoot::Open(folder_.path() / "root");
    ASSERT_TRUE(root.ok()) << root.status();
    root_ = *std::move(root);
  }

  void Write(const std::string& name, const std::string& bytes) {
    const fs::path path = folder_.path() / name;
    fs::create_directories(path.parent_path());
    std::ofstream(path) << bytes;
  }
  void Link(const std::string& name, const std::string& target) {
    fs::create_symlink(target, folder_.path() / "root" / name);
  }
  absl::Status ReadStatus(const std::string& folder, const std::string& file) {
    return root_->Read(folder, file, 100).status();
  }

  TemporaryDirectory folder_;
  std::unique_ptr<ImportRoot> root_;
};

TEST_F(ImportRootTest, ListsFilesAtAnyDepthInOrder) {
  ASSERT_OK_AND_ASSIGN(const auto all, root_->ListFiles("", {}));
  EXPECT_THAT(all, ElementsAre("a.off", "cups/b.STL", "cups/deep/c.ply",
                               "cups/notes.txt"));
  ASSERT_OK_AND_ASSIGN(const auto cups, root_->ListFiles("cups", {}));
  EXPECT_THAT(cups, ElementsAre("b.STL", "deep/c.ply", "notes.txt"));
  fs::create_directory(folder_.path() / "root/empty");
  ASSERT_OK_AND_ASSIGN(const auto none, root_->ListFiles("empty", {}));
  const StopToken late({}, absl::InfinitePast());
  EXPECT_TRUE(absl::IsDeadlineExceeded(root_->ListFiles("", late).status()));
  EXPECT_THAT(none, IsEmpty());
}

TEST_F(ImportRootTest, ReadsTheBytesOfAFile) {
  ASSERT_OK_AND_ASSIGN(const std::string root, root_->Read("", "a.off", 100));
  EXPECT_EQ(root, "a");
  ASSERT_OK_AND_ASSIGN(const std::string deep,
                       root_->Read("cups", "deep/c.ply", 3));
  EXPECT_EQ(deep, "ccc");
}

TEST_F(ImportRootTest, RefusesAFileFromItsSize) {
  EXPECT_EQ(ReasonOf(root_->Read("cups", "deep/c.ply", 2).status()),
            ErrorReason::kMeshTooLarge);
}

TEST_F(ImportRootTest, NeverLeavesTheRoot) {
  const std::string outside = (folder_.path() / "secret.off").string();
  for (const auto& [folder, file] :
       {std::pair<std::string, std::string>{"", "../secret.off"},
        {"..", "secret.off"},
        {"cups/../..", "secret.off"},
        {"", outside},
        {folder_.path().string(), "secret.off"},
        {"", std::string("../secret.off\0.off", 18)}}) {
    const absl::Status status = ReadStatus(folder, file);
    EXPECT_EQ(ReasonOf(status), ErrorReason::kFileUnreadable)
        << folder << " " << file << ": " << status;
  }
  for (const std::string folder : {"..", "cups/../..", "/", "/etc"}) {
    EXPECT_EQ(ReasonOf(root_->ListFiles(folder, {}).status()),
              ErrorReason::kFileUnreadable)
        << folder;
  }
}

TEST_F(ImportRootTest, FollowsNoLinkEvenToAFileBelowTheRoot) {
  Link("inside.off", "a.off");
  Link("outside.off", "../secret.off");
  Link("folder", "cups");
  ASSERT_OK_AND_ASSIGN(const auto all, root_->ListFiles("", {}));
  EXPECT_THAT(all, ElementsAre("a.off", "cups/b.STL", "cups/deep/c.ply",
                               "cups/notes.txt", "folder", "inside.off",
                               "outside.off"));
  for (const char* file : {"inside.off", "outside.off", "folder/b.STL"}) {
    const absl::Status status = ReadStatus("", file);
    EXPECT_EQ(ReasonOf(status), ErrorReason::kFileUnreadable) << file;
    EXPECT_THAT(std::string(status.message()), HasSubstr("over a link"));
    EXPECT_EQ(MetadataOf(status)["path"], file);
  }
  EXPECT_EQ(ReasonOf(root_->ListFiles("folder", {}).status()),
            ErrorReason::kFileUnreadable);
}

TEST_F(ImportRootTest, ReadsOnlyFilesAndWaitsForNobody) {
  ASSERT_EQ(mkfifo((folder_.path() / "root/pipe.off").c_str(), 0600), 0);
  fs::create_directory(folder_.path() / "root/folder.off");
  for (const char* file : {"pipe.off", "folder.off", "none.off"}) {
    EXPECT_EQ(ReasonOf(ReadStatus("", file)), ErrorReason::kFileUnreadable)
        << file;
  }
  ASSERT_OK_AND_ASSIGN(const auto all, root_->ListFiles("", {}));
  EXPECT_THAT(all, ElementsAre("a.off", "cups/b.STL", "cups/deep/c.ply",
                               "cups/notes.txt"));
}

TEST_F(ImportRootTest, RefusesARootThatIsNoFolder) {
  for (const char* root : {"none", "root/a.off"}) {
    EXPECT_THAT(ImportRoot::Open(folder_.path() / root),
                StatusIs(absl::StatusCode::kUnavailable, HasSubstr(root)));
  }
}

}  // namespace
}  // namespace argmesh
