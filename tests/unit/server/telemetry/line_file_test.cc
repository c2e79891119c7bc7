#include "server/telemetry/line_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/temporary_directory.h"

namespace argmesh {
namespace {

std::vector<std::string> LinesOf(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(LineFile, AddsToWhatIsThere) {
  const TemporaryDirectory folder;
  const std::string path = folder.path() / "log";
  {
    auto file = LineFile::Open(path);
    ASSERT_TRUE(file.ok()) << file.status();
    (*file)->Write("one");
  }
  auto file = LineFile::Open(path);
  ASSERT_TRUE(file.ok()) << file.status();
  (*file)->Write("two");
  EXPECT_EQ(LinesOf(path), (std::vector<std::string>{"one", "two"}));
}

TEST(LineFile, IsPrivateToItsOwner) {
  const TemporaryDirectory folder;
  const std::string path = folder.path() / "log";
  ASSERT_TRUE(LineFile::Open(path).ok());
  struct stat status {};
  ASSERT_EQ(stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600U);
}

TEST(LineFile, FollowsARotation) {
  const TemporaryDirectory folder;
  const std::string path = folder.path() / "log";
  auto file = LineFile::Open(path);
  ASSERT_TRUE(file.ok()) << file.status();
  (*file)->Write("one");
  std::filesystem::rename(path, path + ".1");
  (*file)->Write("two");
  ASSERT_TRUE((*file)->Reopen().ok());
  (*file)->Write("three");
  EXPECT_EQ(LinesOf(path + ".1"), (std::vector<std::string>{"one", "two"}));
  EXPECT_EQ(LinesOf(path), std::vector<std::string>{"three"});
}

TEST(LineFile, KeepsItsFileWhenThePathCannotBeOpenedAgain) {
  const TemporaryDirectory folder;
  const std::filesystem::path inner = folder.path() / "inner";
  std::filesystem::create_directory(inner);
  auto file = LineFile::Open(inner / "log");
  ASSERT_TRUE(file.ok()) << file.status();
  std::filesystem::rename(inner, folder.path() / "moved");
  EXPECT_FALSE((*file)->Reopen().ok());
  (*file)->Write("still");
  EXPECT_EQ(LinesOf(folder.path() / "moved" / "log"),
            std::vector<std::string>{"still"});
}

TEST(LineFile, TakesTwiceItsBoundAtMost) {
  const TemporaryDirectory folder;
  const std::string path = folder.path() / "log";
  std::ofstream(path) << "before\n";
  auto file = LineFile::Open(path, 14);
  ASSERT_TRUE(file.ok()) << file.status();
  for (const char* line : {"line 1", "line 2", "line 3", "line 4"}) {
    (*file)->Write(line);
  }
  EXPECT_EQ(LinesOf(path + ".1"),
            (std::vector<std::string>{"line 2", "line 3"}));
  EXPECT_EQ(LinesOf(path), std::vector<std::string>{"line 4"});
  (*file)->Write("a line that is longer than all of it");
  (*file)->Write("line 5");
  EXPECT_EQ(LinesOf(path), std::vector<std::string>{"line 5"});
  EXPECT_EQ((*file)->dropped(), 0);
  struct stat status {};
  ASSERT_EQ(stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600U);
}

TEST(LineFile, DropsLinesRatherThanGrowBeyondItsBound) {
  const TemporaryDirectory folder;
  const std::string path = folder.path() / "log";
  auto file = LineFile::Open(path, 14);
  ASSERT_TRUE(file.ok()) << file.status();
  std::filesystem::create_directories(path + ".1/in the way");
  for (const char* line : {"line 1", "line 2", "line 3"}) (*file)->Write(line);
  EXPECT_EQ((*file)->dropped(), 1);
  std::filesystem::remove_all(path + ".1");
  (*file)->Write("line 4");
  EXPECT_EQ(LinesOf(path), std::vector<std::string>{"line 4"});
}

TEST(LineFile, BoundsNothingButFiles) {
  auto file = LineFile::Open("/dev/null", 3);
  ASSERT_TRUE(file.ok()) << file.status();
  for (int i = 0; i < 3; ++i) (*file)->Write("line");
  EXPECT_EQ((*file)->dropped(), 0);
}

TEST(LineFile, CountsWhatItCannotWrite) {
  auto file = LineFile::Open("/dev/full");
  ASSERT_TRUE(file.ok()) << file.status();
  (*file)->Write("lost");
  EXPECT_EQ((*file)->dropped(), 1);
}

TEST(LineFile, NamesThePathItCannotOpen) {
  const auto file = LineFile::Open("/no/such/folder/log");
  ASSERT_FALSE(file.ok());
  EXPECT_NE(std::string(file.status().message()).find("/no/such/folder/log"),
            std::string::npos);
}

TEST(LineFile, KeepsLinesOfManyThreadsWhole) {
  const TemporaryDirectory folder;
  const std::string path = folder.path() / "log";
  auto file = LineFile::Open(path);
  ASSERT_TRUE(file.ok()) << file.status();
  const std::string text(3000, 'x');
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      for (int i = 0; i < 50; ++i) (*file)->Write(text);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(LinesOf(path), std::vector<std::string>(200, text));
}

}  // namespace
}  // namespace argmesh
