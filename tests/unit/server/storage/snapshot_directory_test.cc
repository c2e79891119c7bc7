#include "server/storage/snapshot_directory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stop_token>
#include <string>
#include <thread>

#include "absl/time/time.h"
#include "server/engine/error_reason.h"
#include "tests/support/large_database.h"
#include "tests/support/temporary_directory.h"
#include "tests/unit/server/storage/stored_samples.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class SnapshotDirectoryTest : public ::testing::Test {
 protected:
  SnapshotDirectoryTest() : samples_(folder_.path() / "data") {
    samples_.AddCollection("cups");
    for (uint64_t seed = 1; seed <= 3; ++seed) {
      samples_.AddShape("cups", "cup-" + std::to_string(seed), seed);
    }
  }

  std::filesystem::path BlobOf(const std::string& id) {
    const auto record = samples_.catalog().GetShape("cups", id);
    EXPECT_TRUE(record.ok()) << record.status();
    const std::string digits = ToHex(record->sha256);
    return samples_.path() / "blobs" / digits.substr(0, 2) / digits;
  }

  size_t FilesOfSnapshots() const {
    const std::filesystem::directory_iterator files(samples_.path() /
                                                    "snapshots");
    return static_cast<size_t>(std::distance(begin(files), end(files)));
  }

  void MakeCatalogLarge() {
    samples_.Close();
    const absl::Status large = MakeLarge(samples_.path() / "catalog.db");
    ASSERT_TRUE(large.ok()) << large;
    samples_.Open();
  }

  const TemporaryDirectory folder_;
  StoredSamples samples_;
};

TEST_F(SnapshotDirectoryTest, MakesListsReadsAndRemovesSnapshots) {
  const auto made = samples_.snapshots().CreateSnapshot("one", {});
  ASSERT_TRUE(made.ok()) << made.status();
  EXPECT_EQ(made->id, "one");
  const auto reader = samples_.snapshots().OpenSnapshot("one");
  ASSERT_TRUE(reader.ok()) << reader.status();
  std::string bytes;
  while (true) {
    const auto piece = (*reader)->Read(5000);
    ASSERT_TRUE(piece.ok()) << piece.status();
    if (piece->empty()) break;
    bytes += *piece;
  }
  EXPECT_EQ(static_cast<int64_t>(bytes.size()), made->size_bytes);
  EXPECT_EQ(ComputeSha256(bytes), made->sha256);

  ASSERT_TRUE(samples_.snapshots().CreateSnapshot("another", {}).ok());
  const auto list = samples_.snapshots().ListSnapshots();
  ASSERT_TRUE(list.ok()) << list.status();
  ASSERT_EQ(list->size(), 2U);
  EXPECT_EQ((*list)[0].id, "another");
  EXPECT_EQ((*list)[1].id, "one");
  ASSERT_TRUE(samples_.snapshots().DeleteSnapshot("one").ok());
  EXPECT_EQ(samples_.snapshots().ListSnapshots()->size(), 1U);
  EXPECT_EQ(FilesOfSnapshots(), 2U);
}

TEST_F(SnapshotDirectoryTest, SaysWhatIsMissingOrTaken) {
  ASSERT_TRUE(samples_.snapshots().CreateSnapshot("one", {}).ok());
  EXPECT_EQ(ReasonOf(samples_.snapshots().CreateSnapshot("one", {}).status()),
            ErrorReason::kSnapshotExists);
  EXPECT_EQ(ReasonOf(samples_.snapshots().GetSnapshot("two").status()),
            ErrorReason::kSnapshotNotFound);
  EXPECT_EQ(ReasonOf(samples_.snapshots().OpenSnapshot("two").status()),
            ErrorReason::kSnapshotNotFound);
  EXPECT_EQ(ReasonOf(samples_.snapshots().DeleteSnapshot("two")),
            ErrorReason::kSnapshotNotFound);
}

TEST_F(SnapshotDirectoryTest, PutsNothingDamagedIntoASnapshot) {
  std::fstream blob(BlobOf("cup-2"), std::ios::in | std::ios::out);
  blob.seekp(10).put('!');
  blob.close();
  EXPECT_EQ(ReasonOf(samples_.snapshots().CreateSnapshot("one", {}).status()),
            ErrorReason::kStoredDataDamaged);
  EXPECT_EQ(FilesOfSnapshots(), 0U);
}

TEST_F(SnapshotDirectoryTest, LeavesNothingBehindWhenItIsStopped) {
  std::stop_source source;
  source.request_stop();
  const StopToken stop(source.get_token(), absl::InfiniteFuture());
  EXPECT_EQ(samples_.snapshots().CreateSnapshot("one", stop).status().code(),
            absl::StatusCode::kCancelled);
  EXPECT_EQ(FilesOfSnapshots(), 0U);
}

TEST_F(SnapshotDirectoryTest, StopsWithinTheCopyOfTheCatalog) {
  ASSERT_NO_FATAL_FAILURE(MakeCatalogLarge());
  const double begin = ThreadSeconds();
  ASSERT_TRUE(samples_.snapshots().CreateSnapshot("whole", {}).ok());
  const double whole = ThreadSeconds() - begin;
  ASSERT_TRUE(samples_.snapshots().DeleteSnapshot("whole").ok());
  const StopToken over({}, absl::UnixEpoch());
  EXPECT_EQ(samples_.snapshots().CreateSnapshot("one", over).status().code(),
            absl::StatusCode::kDeadlineExceeded);
  EXPECT_LT(ThreadSeconds() - begin - whole, whole / 4);
  EXPECT_EQ(FilesOfSnapshots(), 0U);
}

TEST_F(SnapshotDirectoryTest, WaitsForAnotherUntilItIsStopped) {
  ASSERT_NO_FATAL_FAILURE(MakeCatalogLarge());
  std::stop_source source;
  absl::Status other;
  std::thread making([&] {
    other = samples_.snapshots()
                .CreateSnapshot("other", StopToken(source.get_token(),
                                                   absl::InfiniteFuture()))
                .status();
  });
  while (FilesOfSnapshots() == 0) std::this_thread::yield();
  EXPECT_EQ(samples_.snapshots()
                .CreateSnapshot("one", StopToken({}, absl::UnixEpoch()))
                .status()
                .code(),
            absl::StatusCode::kDeadlineExceeded);
  source.request_stop();
  making.join();
  EXPECT_EQ(other.code(), absl::StatusCode::kCancelled)
      << "waited for the other to end";
}

TEST_F(SnapshotDirectoryTest, RemovesAtTheStartWhatACrashLeft) {
  samples_.Close();
  std::ofstream(samples_.path() / "snapshots" / "one.tar.part") << "half";
  samples_.Open();
  EXPECT_EQ(FilesOfSnapshots(), 0U);
}

TEST_F(SnapshotDirectoryTest, KeepsMeshesUntilNothingHoldsRemovalsAnyMore) {
  const std::filesystem::path blob = BlobOf("cup-1");
  const std::filesystem::path named = BlobOf("cup-2");
  const Sha256Digest sha256 =
      samples_.catalog().GetShape("cups", "cup-1")->sha256;
  const auto is_referenced = [&](const Sha256Digest& other) {
    return absl::StatusOr<bool>(other != sha256);
  };
  MeshPin first = samples_.meshes().HoldRemovals();
  MeshPin second = samples_.meshes().HoldRemovals();
  for (const char* id : {"cup-1", "cup-2"}) {
    ASSERT_TRUE(
        samples_.meshes()
            .RemoveUnreferenced(samples_.catalog().GetShape("cups", id)->sha256,
                                is_referenced)
            .ok());
  }
  first.reset();
  EXPECT_TRUE(std::filesystem::exists(blob));
  second.reset();
  EXPECT_FALSE(std::filesystem::exists(blob));
  EXPECT_TRUE(std::filesystem::exists(named)) << "a row names it again";
}

TEST_F(SnapshotDirectoryTest, LetsAHoldOutliveTheStore) {
  const std::filesystem::path blob = BlobOf("cup-1");
  const MeshPin hold = samples_.meshes().HoldRemovals();
  ASSERT_TRUE(samples_.meshes()
                  .RemoveUnreferenced(
                      samples_.catalog().GetShape("cups", "cup-1")->sha256,
                      [](const Sha256Digest&) -> absl::StatusOr<bool> {
                        ADD_FAILURE() << "nobody is left to ask";
                        return false;
                      })
                  .ok());
  samples_.Close();
}

TEST_F(SnapshotDirectoryTest, FindsNothingInASoundStore) {
  const auto report = samples_.snapshots().Verify("", {});
  ASSERT_TRUE(report.ok()) << report.status();
  EXPECT_EQ(report->findings, 0) << report->first_findings.front();
  EXPECT_EQ(report->shapes, 3);
  EXPECT_EQ(report->meshes, 3);
  EXPECT_EQ(report->checksums, 15) << "five of each shape";
  EXPECT_GT(report->mesh_bytes, 300);
}

TEST_F(SnapshotDirectoryTest, ChecksOneCollectionAlone) {
  samples_.AddCollection("empty");
  std::filesystem::remove(BlobOf("cup-1"));
  const auto cups = samples_.snapshots().Verify("cups", {});
  ASSERT_TRUE(cups.ok()) << cups.status();
  EXPECT_EQ(cups->shapes, 3);
  EXPECT_EQ(cups->meshes, 3);
  EXPECT_EQ(cups->checksums, 15);
  EXPECT_EQ(cups->findings, 1);
  const auto none = samples_.snapshots().Verify("empty", {});
  ASSERT_TRUE(none.ok()) << none.status();
  EXPECT_EQ(none->shapes + none->meshes + none->checksums + none->findings, 0);
  EXPECT_EQ(ReasonOf(samples_.snapshots().Verify("nobody", {}).status()),
            ErrorReason::kCollectionNotFound);
}

TEST_F(SnapshotDirectoryTest, StopsAVerification) {
  std::stop_source source;
  source.request_stop();
  const StopToken stopped(source.get_token(), absl::InfiniteFuture());
  EXPECT_EQ(samples_.snapshots().Verify("", stopped).status().code(),
            absl::StatusCode::kCancelled);
}

TEST_F(SnapshotDirectoryTest, FindsEveryKindOfDamage) {
  std::filesystem::remove(BlobOf("cup-1"));
  std::filesystem::resize_file(BlobOf("cup-2"), 5);
  std::fstream blob(BlobOf("cup-3"), std::ios::in | std::ios::out);
  blob.seekp(10).put('!');
  blob.close();
  samples_.Close();
  {
    auto connection = SqliteConnection::Open(
        samples_.path() / "catalog.db", SqliteConnection::Mode::kReadWrite);
    ASSERT_TRUE(connection.ok()) << connection.status();
    for (const char* sql :
         {"UPDATE graph SET crc32c = crc32c + 1 WHERE shape_id = 1",
          "UPDATE face_label SET labels = x'00' WHERE graph_id = 2",
          "UPDATE signature SET crc32c = 0 WHERE shape_id = 2",
          "UPDATE surface_windows SET words = x'01' WHERE shape_id = 3",
          "UPDATE surface_windows SET windows = x'01' WHERE shape_id = 3",
          "DELETE FROM graph WHERE shape_id = 3"}) {
      ASSERT_TRUE((*connection)->Execute(sql).ok()) << sql;
    }
  }
  samples_.Open();
  const auto report = samples_.snapshots().Verify("", {});
  ASSERT_TRUE(report.ok()) << report.status();
  EXPECT_EQ(report->findings, 9);
  EXPECT_THAT(report->first_findings,
              ElementsAre(HasSubstr("cup-3: its graph is missing"),
                          HasSubstr("cup-1: arg"), HasSubstr("cup-2: labels"),
                          HasSubstr("cup-2: bytes"), HasSubstr("cup-3: words"),
                          HasSubstr("cup-3: windows"), HasSubstr("mesh"),
                          HasSubstr("mesh"), HasSubstr("mesh")));
}

}  // namespace
}  // namespace argmesh
