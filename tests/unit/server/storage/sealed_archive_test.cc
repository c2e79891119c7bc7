#include "server/storage/sealed_archive.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "server/engine/error_reason.h"
#include "tests/support/temporary_directory.h"

namespace argmesh {
namespace {

using Members = std::vector<std::pair<std::string, std::string>>;

class SealedArchiveTest : public ::testing::Test {
 protected:
  ArchiveSummary Write(const Members& members) {
    std::filesystem::remove(path_);
    auto writer = ArchiveWriter::Create(path_);
    EXPECT_TRUE(writer.ok()) << writer.status();
    for (const auto& [name, bytes] : members) {
      EXPECT_TRUE(
          (*writer)->Begin(name, static_cast<int64_t>(bytes.size())).ok());
      EXPECT_TRUE((*writer)->Append(bytes).ok());
    }
    const auto summary = (*writer)->Finish();
    EXPECT_TRUE(summary.ok()) << summary.status();
    return *summary;
  }

  absl::StatusOr<Members> Read() const {
    Members members;
    auto reader = ArchiveReader::Open(path_);
    if (!reader.ok()) return reader.status();
    while (true) {
      ArchiveMember member;
      const auto more = (*reader)->Next(member);
      if (!more.ok()) return more.status();
      if (!*more) return members;
      std::string content;
      while (true) {
        const auto bytes = (*reader)->Read(100);
        if (!bytes.ok()) return bytes.status();
        if (bytes->empty()) break;
        content += *bytes;
      }
      members.emplace_back(member.name, content);
    }
  }

  std::string Bytes() const {
    std::ifstream in(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void Store(const std::string& bytes) const {
    std::ofstream(path_, std::ios::binary | std::ios::trunc) << bytes;
  }
  void ExpectDamaged(const std::string& bytes, const std::string& what) const {
    Store(bytes);
    EXPECT_EQ(ReasonOf(Read().status()), ErrorReason::kStoredDataDamaged)
        << what;
  }

  const TemporaryDirectory folder_;
  const std::filesystem::path path_ = folder_.path() / "archive.tar";
  const Members members_ = {{"first", "one"},
                            {"empty", ""},
                            {"blobs/ab/block", std::string(512, 'b')},
                            {"longer", std::string(1300, 'c')}};
};

TEST_F(SealedArchiveTest, ReadsBackWhatWasWritten) {
  const ArchiveSummary summary = Write(members_);
  const auto read = Read();
  ASSERT_TRUE(read.ok()) << read.status();
  EXPECT_EQ(*read, members_);
  const std::string bytes = Bytes();
  EXPECT_EQ(summary.size_bytes, static_cast<int64_t>(bytes.size()));
  EXPECT_EQ(summary.sha256, ComputeSha256(bytes));
  Write({});
  EXPECT_EQ(Read().value(), Members());
}

TEST_F(SealedArchiveTest, IsATarArchive) {
  Write(members_);
  const std::string unpacked = folder_.path() / "unpacked";
  std::filesystem::create_directory(unpacked);
  const std::string command = "tar -xf " + path_.string() + " -C " + unpacked;
  ASSERT_EQ(std::system(command.c_str()), 0);
  for (const auto& [name, content] : members_) {
    std::ifstream in(unpacked + "/" + name, std::ios::binary);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), content)
        << name;
  }
}

TEST_F(SealedArchiveTest, NoticesEveryChangedByte) {
  Write(members_);
  const std::string bytes = Bytes();
  Random random(7);
  for (size_t i = 0; i < bytes.size(); ++i) {
    std::string changed = bytes;
    changed[i] = static_cast<char>(changed[i] ^
                                   static_cast<char>(1 + random.Below(255)));
    ExpectDamaged(changed, "byte " + std::to_string(i));
  }
}

TEST_F(SealedArchiveTest, NoticesEveryMissingOrAdditionalByte) {
  Write(members_);
  const std::string bytes = Bytes();
  for (size_t size = 0; size < bytes.size(); ++size) {
    ExpectDamaged(bytes.substr(0, size), "cut to " + std::to_string(size));
  }
  ExpectDamaged(bytes + '\0', "one more byte");
  ExpectDamaged(bytes + bytes, "twice");
}

TEST_F(SealedArchiveTest, NoticesAMissingMember) {
  Write(members_);
  const std::string bytes = Bytes();
  ExpectDamaged(bytes.substr(1024), "without the first member");
}

TEST_F(SealedArchiveTest, WritesOnlyWholeMembers) {
  auto writer = ArchiveWriter::Create(path_);
  ASSERT_TRUE(writer.ok()) << writer.status();
  ASSERT_TRUE((*writer)->Begin("a", 3).ok());
  ASSERT_TRUE((*writer)->Append("ab").ok());
  EXPECT_FALSE((*writer)->Append("cd").ok());
  EXPECT_FALSE((*writer)->Finish().ok());
  EXPECT_FALSE((*writer)->Begin(std::string(100, 'n'), 0).ok());
}

TEST_F(SealedArchiveTest, LeavesAFileThatIsThereAlone) {
  Store("something");
  EXPECT_FALSE(ArchiveWriter::Create(path_).ok());
  EXPECT_EQ(Bytes(), "something");
}

}  // namespace
}  // namespace argmesh
