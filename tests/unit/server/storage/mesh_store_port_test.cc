// What every MeshStore promises, whatever it is made of.
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "absl/time/clock.h"
#include "server/engine/error_reason.h"
#include "server/engine/mesh_store.h"
#include "server/storage/directory_mesh_store.h"
#include "tests/support/disk_ballast.h"
#include "tests/support/memory_mesh_store.h"
#include "tests/support/status_matchers.h"
#include "tests/support/temporary_directory.h"

namespace argmesh {
namespace {

namespace fs = std::filesystem;

absl::StatusOr<bool> Never(const Sha256Digest&) { return false; }
absl::StatusOr<bool> Always(const Sha256Digest&) { return true; }

absl::StatusOr<std::unique_ptr<StagedMesh>> Stage(MeshStore& store,
                                                  const std::string& bytes) {
  ARGMESH_ASSIGN_OR_RETURN(
      const std::unique_ptr<MeshWriter> writer,
      store.StartWrite(static_cast<int64_t>(bytes.size())));
  const size_t half = bytes.size() / 2;
  ARGMESH_RETURN_IF_ERROR(writer->Append(bytes.substr(0, half)));
  ARGMESH_RETURN_IF_ERROR(writer->Append(bytes.substr(half)));
  return writer->Seal();
}

absl::StatusOr<MeshPin> Store(MeshStore& store, const std::string& bytes) {
  ARGMESH_ASSIGN_OR_RETURN(const std::unique_ptr<StagedMesh> staged,
                           Stage(store, bytes));
  return staged->Publish();
}

absl::StatusOr<std::string> ReadBack(const MeshStore& store,
                                     const std::string& bytes,
                                     int64_t piece_bytes) {
  ARGMESH_ASSIGN_OR_RETURN(const std::unique_ptr<MeshReader> reader,
                           store.Open(ComputeSha256(bytes)));
  std::string all;
  while (true) {
    ARGMESH_ASSIGN_OR_RETURN(const std::string piece,
                             reader->Read(piece_bytes));
    if (piece.empty()) return all;
    all += piece;
  }
}

size_t CountFiles(const fs::path& folder) {
  size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) ++files;
  }
  return files;
}

enum class StoreKind { kMemory, kDirectory };

class MeshStorePortTest : public ::testing::TestWithParam<StoreKind> {
 protected:
  void SetUp() override {
    if (GetParam() == StoreKind::kMemory) {
      store_ = std::make_unique<MemoryMeshStore>();
      return;
    }
    absl::StatusOr<std::shared_ptr<DataDirectory>> directory =
        DataDirectory::Open(
            folder_.path() / "data",
            {.min_free_bytes = 0, .allow_network_file_system = true});
    ASSERT_TRUE(directory.ok()) << directory.status();
    absl::StatusOr<std::unique_ptr<DirectoryMeshStore>> store =
        DirectoryMeshStore::Open(*std::move(directory));
    ASSERT_TRUE(store.ok()) << store.status();
    store_ = *std::move(store);
  }

  TemporaryDirectory folder_;
  std::unique_ptr<MeshStore> store_;
};

INSTANTIATE_TEST_SUITE_P(Stores, MeshStorePortTest,
                         ::testing::Values(StoreKind::kMemory,
                                           StoreKind::kDirectory),
                         [](const ::testing::TestParamInfo<StoreKind>& kind) {
                           return kind.param == StoreKind::kMemory
                                      ? "Memory"
                                      : "Directory";
                         });

TEST_P(MeshStorePortTest, GivesBackTheBytesInPiecesOfAnySize) {
  const std::string bytes(10'001, 'x');
  ASSERT_THAT(Store(*store_, bytes), IsOk());
  for (const int64_t piece :
       {int64_t{1000}, int64_t{10'001}, int64_t{99'999}}) {
    ASSERT_OK_AND_ASSIGN(const std::string read,
                         ReadBack(*store_, bytes, piece));
    EXPECT_EQ(read, bytes);
  }
}

TEST_P(MeshStorePortTest, KnowsAStagedMeshBeforeItIsPublished) {
  ASSERT_OK_AND_ASSIGN(const std::unique_ptr<StagedMesh> staged,
                       Stage(*store_, "mesh"));
  EXPECT_EQ(staged->sha256(), ComputeSha256("mesh"));
  EXPECT_EQ(staged->size_bytes(), 4);
  ASSERT_OK_AND_ASSIGN(const std::string bytes, staged->ReadAll());
  EXPECT_EQ(bytes, "mesh");
  EXPECT_EQ(ReasonOf(ReadBack(*store_, "mesh", 9).status()),
            ErrorReason::kStoredDataDamaged);
}

TEST_P(MeshStorePortTest, KeepsOneCopyOfEqualMeshes) {
  ASSERT_THAT(Store(*store_, "mesh"), IsOk());
  ASSERT_THAT(Store(*store_, "mesh"), IsOk());
  ASSERT_THAT(store_->RemoveUnreferenced(ComputeSha256("mesh"), Never), IsOk());
  EXPECT_FALSE(ReadBack(*store_, "mesh", 9).ok());
}

TEST_P(MeshStorePortTest, RemovesOnlyWhatNobodyNamesOrHolds) {
  const Sha256Digest sha256 = ComputeSha256("mesh");
  ASSERT_OK_AND_ASSIGN(MeshPin pin, Store(*store_, "mesh"));
  ASSERT_THAT(store_->RemoveUnreferenced(sha256, Never), IsOk());
  EXPECT_THAT(ReadBack(*store_, "mesh", 9), IsOk());
  pin.reset();
  ASSERT_THAT(store_->RemoveUnreferenced(sha256, Always), IsOk());
  EXPECT_THAT(ReadBack(*store_, "mesh", 9), IsOk());
  ASSERT_THAT(store_->RemoveUnreferenced(sha256, Never), IsOk());
  EXPECT_FALSE(ReadBack(*store_, "mesh", 9).ok());
  EXPECT_THAT(store_->RemoveUnreferenced(sha256, Never), IsOk());
}

TEST_P(MeshStorePortTest, KeepsAMeshWhenItCannotTellWhetherItIsNamed) {
  ASSERT_THAT(Store(*store_, "mesh"), IsOk());
  EXPECT_THAT(store_->RemoveUnreferenced(
                  ComputeSha256("mesh"),
                  [](const Sha256Digest&) -> absl::StatusOr<bool> {
                    return absl::UnavailableError("later");
                  }),
              StatusIs(absl::StatusCode::kUnavailable, "later"));
  EXPECT_THAT(ReadBack(*store_, "mesh", 9), IsOk());
}

TEST_P(MeshStorePortTest, SweepsWhatIsOldAndNotNamed) {
  ASSERT_THAT(Store(*store_, "kept"), IsOk());
  ASSERT_THAT(Store(*store_, "gone"), IsOk());
  const auto is_kept = [](const Sha256Digest& sha256) -> absl::StatusOr<bool> {
    return sha256 == ComputeSha256("kept");
  };
  ASSERT_OK_AND_ASSIGN(const int64_t young,
                       store_->Sweep(absl::Now() - absl::Hours(1), is_kept));
  EXPECT_EQ(young, 0);
  ASSERT_OK_AND_ASSIGN(const int64_t old,
                       store_->Sweep(absl::Now() + absl::Hours(1), is_kept));
  EXPECT_EQ(old, 1);
  EXPECT_THAT(ReadBack(*store_, "kept", 9), IsOk());
  EXPECT_FALSE(ReadBack(*store_, "gone", 9).ok());
}

class DirectoryMeshStoreTest : public ::testing::Test {
 protected:
  void Open() {
    store_.reset();
    ASSERT_OK_AND_ASSIGN(
        std::shared_ptr<DataDirectory> directory,
        DataDirectory::Open(data_, {.min_free_bytes = min_free_bytes_,
                                    .allow_network_file_system = true}));
    ASSERT_OK_AND_ASSIGN(store_, DirectoryMeshStore::Open(directory));
  }
  fs::path PathOf(const std::string& bytes) const {
    const std::string name = ToHex(ComputeSha256(bytes));
    return data_ / "blobs" / name.substr(0, 2) / name;
  }

  TemporaryDirectory folder_;
  fs::path data_ = folder_.path() / "data";
  int64_t min_free_bytes_ = 0;
  std::unique_ptr<DirectoryMeshStore> store_;
};

TEST_F(DirectoryMeshStoreTest, LeavesNothingOfAMeshThatIsNotPublished) {
  Open();
  {
    ASSERT_OK_AND_ASSIGN(const std::unique_ptr<StagedMesh> staged,
                         Stage(*store_, "mesh"));
    ASSERT_OK_AND_ASSIGN(const std::unique_ptr<MeshWriter> writer,
                         store_->StartWrite(0));
    EXPECT_EQ(CountFiles(data_ / "incoming"), 2U);
  }
  EXPECT_EQ(CountFiles(data_ / "incoming"), 0U);
  EXPECT_EQ(CountFiles(data_ / "blobs"), 0U);
}

TEST_F(DirectoryMeshStoreTest, EmptiesIncomingAtTheStart) {
  Open();
  std::ofstream(data_ / "incoming" / "17") << "left by a crash";
  Open();
  EXPECT_EQ(CountFiles(data_ / "incoming"), 0U);
}

TEST_F(DirectoryMeshStoreTest, FindsBytesThatWereChangedOrCut) {
  Open();
  ASSERT_THAT(Store(*store_, "mesh"), IsOk());
  std::ofstream(PathOf("mesh")) << "mash";
  EXPECT_EQ(ReasonOf(ReadBack(*store_, "mesh", 2).status()),
            ErrorReason::kStoredDataDamaged);
  std::ofstream(PathOf("mesh")) << "me";
  EXPECT_EQ(ReasonOf(ReadBack(*store_, "mesh", 9).status()),
            ErrorReason::kStoredDataDamaged);
  std::ofstream(PathOf("mesh")).flush();
  EXPECT_EQ(ReasonOf(ReadBack(*store_, "mesh", 9).status()),
            ErrorReason::kStoredDataDamaged);
}

TEST_F(DirectoryMeshStoreTest, HealsADamagedMeshThatComesAgain) {
  Open();
  ASSERT_THAT(Store(*store_, "mesh"), IsOk());
  std::ofstream(PathOf("mesh")) << "mash";
  ASSERT_THAT(Store(*store_, "mesh"), IsOk());
  ASSERT_OK_AND_ASSIGN(const std::string bytes, ReadBack(*store_, "mesh", 9));
  EXPECT_EQ(bytes, "mesh");
}

TEST_F(DirectoryMeshStoreTest, RefusesAMeshThatDoesNotFit) {
  Open();
  EXPECT_EQ(ReasonOf(store_->StartWrite(int64_t{1} << 60).status()),
            ErrorReason::kStoreFull);
}

TEST_F(DirectoryMeshStoreTest, CountsWhatOtherWritersHaveAnnounced) {
  min_free_bytes_ = FreeDiskBytes() - kDiskMargin;
  Open();
  constexpr int64_t kMost = kDiskMargin * 3 / 4;
  ASSERT_OK_AND_ASSIGN(std::unique_ptr<MeshWriter> first,
                       store_->StartWrite(kMost));
  EXPECT_EQ(ReasonOf(store_->StartWrite(kMost).status()),
            ErrorReason::kStoreFull);
  first.reset();
  EXPECT_THAT(store_->StartWrite(kMost), IsOk());
}

TEST_F(DirectoryMeshStoreTest, RefusesWhatWasNotAnnouncedOnAFullDisk) {
  if (FreeDiskBytes() < 4 * kDiskMargin) GTEST_SKIP() << "too little to fill";
  min_free_bytes_ = FreeDiskBytes() - kDiskMargin;
  Open();
  ASSERT_OK_AND_ASSIGN(const std::unique_ptr<MeshWriter> announced,
                       store_->StartWrite(4));
  ASSERT_OK_AND_ASSIGN(const std::unique_ptr<MeshWriter> unknown,
                       store_->StartWrite(0));
  const DiskBallast ballast(folder_.path() / "ballast");
  if (!ballast.Take(2 * kDiskMargin)) GTEST_SKIP() << "no fallocate here";
  EXPECT_THAT(announced->Append("mesh"), IsOk());
  EXPECT_EQ(ReasonOf(announced->Append("more")), ErrorReason::kStoreFull);
  EXPECT_EQ(ReasonOf(unknown->Append("mesh")), ErrorReason::kStoreFull);
}

}  // namespace
}  // namespace argmesh
