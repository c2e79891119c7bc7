#include "server/storage/data_directory.h"

#include <unistd.h>

#include <filesystem>
#include <memory>
#include <string>

#include "server/engine/error_reason.h"
#include "tests/support/disk_ballast.h"
#include "tests/support/status_matchers.h"
#include "tests/support/temporary_directory.h"

namespace argmesh {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr DataDirectoryOptions kOptions{.min_free_bytes = 0,
                                        .allow_network_file_system = true};

TEST(DataDirectory, IsMadeWithItsParentsAndPrivate) {
  const TemporaryDirectory folder;
  const fs::path path = folder.path() / "a" / "b";
  ASSERT_OK_AND_ASSIGN(const std::shared_ptr<DataDirectory> directory,
                       DataDirectory::Open(path, kOptions));
  EXPECT_TRUE(fs::is_directory(directory->blobs_path()));
  EXPECT_TRUE(fs::is_directory(directory->incoming_path()));
  EXPECT_EQ(fs::status(path).permissions() & fs::perms::all,
            fs::perms::owner_all);
}

TEST(DataDirectory, BelongsToOneOwnerAtATime) {
  const TemporaryDirectory folder;
  const fs::path path = folder.path() / "data";
  {
    ASSERT_OK_AND_ASSIGN(const std::shared_ptr<DataDirectory> first,
                         DataDirectory::Open(path, kOptions));
    EXPECT_THAT(DataDirectory::Open(path, kOptions),
                StatusIs(absl::StatusCode::kFailedPrecondition,
                         HasSubstr("process " + std::to_string(getpid()))));
  }
  EXPECT_THAT(DataDirectory::Open(path, kOptions), IsOk());
}

TEST(DataDirectory, RemembersACleanStop) {
  const TemporaryDirectory folder;
  ASSERT_OK_AND_ASSIGN(const std::shared_ptr<DataDirectory> directory,
                       DataDirectory::Open(folder.path() / "data", kOptions));
  EXPECT_FALSE(directory->IsMarkedClean());
  ASSERT_THAT(directory->MarkClean(), IsOk());
  EXPECT_TRUE(directory->IsMarkedClean());
  ASSERT_THAT(directory->ClearCleanMark(), IsOk());
  ASSERT_THAT(directory->ClearCleanMark(), IsOk());
  EXPECT_FALSE(directory->IsMarkedClean());
}

TEST(DataDirectory, KeepsSpaceFree) {
  const TemporaryDirectory folder;
  ASSERT_OK_AND_ASSIGN(const std::shared_ptr<DataDirectory> directory,
                       DataDirectory::Open(folder.path() / "data", kOptions));
  EXPECT_THAT(directory->CheckFreeSpace(1), IsOk());
  const absl::Status full = directory->CheckFreeSpace(int64_t{1} << 60);
  EXPECT_EQ(ReasonOf(full), ErrorReason::kStoreFull);
  EXPECT_TRUE(MetadataOf(full).contains("free_bytes"));
}

TEST(DataDirectory, CountsWhatIsClaimedAsTaken) {
  const TemporaryDirectory folder;
  DataDirectoryOptions options = kOptions;
  options.min_free_bytes = FreeDiskBytes() - kDiskMargin;
  ASSERT_OK_AND_ASSIGN(const std::shared_ptr<DataDirectory> directory,
                       DataDirectory::Open(folder.path() / "data", options));
  constexpr int64_t kMost = kDiskMargin * 3 / 4;
  ASSERT_OK_AND_ASSIGN(SpaceClaim first, directory->Claim(kMost));
  EXPECT_EQ(ReasonOf(directory->Claim(kMost).status()),
            ErrorReason::kStoreFull);
  EXPECT_EQ(ReasonOf(directory->CheckFreeSpace(kMost)),
            ErrorReason::kStoreFull);
  first.Wrote(kMost - 7);
  EXPECT_EQ(first.bytes(), 7);
  {
    ASSERT_OK_AND_ASSIGN(const SpaceClaim second, directory->Claim(kMost));
    EXPECT_FALSE(directory->Claim(kMost).ok());
  }
  first = SpaceClaim();
  EXPECT_THAT(directory->Claim(kMost), IsOk());
}

TEST(DataDirectory, NamesAPathThatCannotBeAFolder) {
  EXPECT_THAT(DataDirectory::Open("/dev/null/data", kOptions),
              StatusIs(absl::StatusCode::kUnavailable, HasSubstr("/dev/null")));
}

}  // namespace
}  // namespace argmesh
