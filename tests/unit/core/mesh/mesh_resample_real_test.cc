#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "core/mesh/mesh_format.h"
#include "core/mesh/mesh_inspect.h"
#include "core/mesh/mesh_repair.h"
#include "core/mesh/mesh_resample.h"
#include "tests/support/real_data.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

TEST(ResampleMesh, KeepsRealShapes) {
  const auto dir = RealDataDir("shrec07_dev");
  if (!dir) GTEST_SKIP() << kRealDataMissing;
  std::vector<std::filesystem::path> paths;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(*dir)) {
    if (entry.path().extension() == ".off") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  ASSERT_FALSE(paths.empty());
  for (size_t i = 0; i < paths.size(); i += 8) {
    SCOPED_TRACE(paths[i].filename());
    std::ifstream file(paths[i], std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    ASSERT_OK_AND_ASSIGN(const ParsedMesh parsed, ParseMesh(bytes));
    ASSERT_OK_AND_ASSIGN(const RepairedMesh repaired, RepairMesh(parsed.mesh));
    ASSERT_OK_AND_ASSIGN(const ResampledMesh resampled,
                         ResampleMesh(repaired.mesh));
    EXPECT_NEAR(resampled.mesh.num_vertices(), 3000, 150);
    const MeshReport after = InspectMesh(resampled.mesh, 0);
    EXPECT_EQ(after.euler_characteristic, repaired.report.euler_characteristic);
    EXPECT_NEAR(after.area / repaired.report.area, 1, 0.1);
  }
}

}  // namespace
}  // namespace argmesh
