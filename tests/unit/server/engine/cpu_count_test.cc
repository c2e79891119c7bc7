#include "server/engine/cpu_count.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temporary_directory.h"

namespace argmesh {
namespace {

TEST(CpusOfQuota, RoundsAQuotaUp) {
  EXPECT_EQ(CpusOfQuota("200000 100000"), 2);
  EXPECT_EQ(CpusOfQuota("150000 100000"), 2);
  EXPECT_EQ(CpusOfQuota("1000 100000"), 1);
  for (const char* none : {"", "max 100000", "-1 100000", "100000", "1 0"}) {
    EXPECT_FALSE(CpusOfQuota(none).has_value()) << none;
  }
  EXPECT_GE(AvailableCpus(), 1);
}

void WriteQuota(const std::filesystem::path& group, const std::string& quota) {
  std::filesystem::create_directories(group);
  std::ofstream(group / "cpu.max") << quota << "\n";
}

TEST(CpusOfCgroup, IsTheSmallestOfAllAround) {
  const TemporaryDirectory root;
  WriteQuota(root.path() / "system.slice", "300000 100000");
  WriteQuota(root.path() / "system.slice/argmeshd.service", "max 100000");
  const std::string own = "0::/system.slice/argmeshd.service\n";
  EXPECT_EQ(CpusOfCgroup(root.path(), own), 3);
  WriteQuota(root.path() / "system.slice/argmeshd.service", "150000 100000");
  EXPECT_EQ(CpusOfCgroup(root.path(), own), 2);
  EXPECT_EQ(CpusOfCgroup(root.path(), "0::/user.slice\n"), std::nullopt);
  // As a container sees itself.
  WriteQuota(root.path(), "100000 100000");
  EXPECT_EQ(CpusOfCgroup(root.path(), "1:cpu:/elsewhere\n0::/\n"), 1);
  EXPECT_EQ(CpusOfCgroup(root.path(), own), 1);
  EXPECT_EQ(CpusOfCgroup(root.path(), "0:://x\n"), 1);
}

}  // namespace
}  // namespace argmesh
