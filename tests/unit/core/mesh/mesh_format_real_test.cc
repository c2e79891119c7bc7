// Mesh files as they are found: every one ends in a mesh that can be written
// and read again, or in a reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "core/mesh/mesh_format.h"
#include "core/mesh/mesh_write.h"
#include "tests/support/real_data.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

std::vector<std::filesystem::path> MeshFilesBelow(
    const std::filesystem::path& root) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(root)) {
    if (entry.is_regular_file() &&
        MeshFormatFromPath(entry.path().string()) != MeshFormat::kUnknown) {
      paths.push_back(entry.path());
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::string ReadBytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The message without what differs from file to file.
std::string Reason(const absl::Status& status) {
  std::string reason = absl::StatusCodeToString(status.code()) + ": ";
  for (const char c : std::string(status.message())) {
    const bool digit = c >= '0' && c <= '9';
    if (!digit) {
      reason += c;
    } else if (reason.back() != '#') {
      reason += '#';
    }
  }
  return reason;
}

void ExpectRoundTrip(const TriangleMesh& mesh) {
  ASSERT_THAT(CheckMesh(mesh), IsOk());
  ASSERT_OK_AND_ASSIGN(const std::string bytes,
                       SerializeMesh(mesh, MeshFormat::kPly));
  ASSERT_OK_AND_ASSIGN(const ParsedMesh again, ParseMesh(bytes));
  EXPECT_EQ(again.mesh.V, mesh.V);
  EXPECT_EQ(again.mesh.F, mesh.F);
}

TEST(ParseMesh, EndsInAMeshOrAReasonForEveryFileFound) {
  const auto root = RealDataDir("wild");
  if (!root) GTEST_SKIP() << kRealDataMissing;
  std::map<std::string, int> reasons;
  int parsed_files = 0;
  for (const std::filesystem::path& path : MeshFilesBelow(*root)) {
    SCOPED_TRACE(path.string());
    const std::string bytes = ReadBytes(path);
    const absl::StatusOr<ParsedMesh> parsed =
        ParseMesh(bytes, MeshFormatFromPath(path.string()));
    if (!parsed.ok()) {
      EXPECT_FALSE(parsed.status().message().empty());
      ++reasons[Reason(parsed.status())];
      continue;
    }
    ++parsed_files;
    EXPECT_GT(parsed->mesh.num_faces(), 0);
    ExpectRoundTrip(parsed->mesh);
    const absl::StatusOr<ParsedMesh> untold = ParseMesh(bytes);
    ASSERT_THAT(untold, IsOk());
    EXPECT_EQ(untold->mesh.F, parsed->mesh.F);
  }
  EXPECT_GT(parsed_files, 0);
  std::cout << parsed_files << " files parsed\n";
  for (const auto& [reason, count] : reasons) {
    std::cout << count << " x " << reason << "\n";
  }
}

TEST(ParseMesh, TakesEveryFileOfTheBenchmarks) {
  for (const std::string_view name :
       {"shrec07_dev", "psb_train", "shrec16_cuts_dev"}) {
    const auto root = RealDataDir(name);
    if (!root) GTEST_SKIP() << kRealDataMissing;
    for (const std::filesystem::path& path : MeshFilesBelow(*root)) {
      EXPECT_THAT(ParseMesh(ReadBytes(path), MeshFormatFromPath(path.string())),
                  IsOk())
          << path;
    }
  }
}

}  // namespace
}  // namespace argmesh
