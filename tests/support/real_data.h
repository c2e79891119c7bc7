// Where the real meshes for measuring are, if they are there at all.
//
//   const auto dir = RealDataDir("shrec07_dev");
//   if (!dir) GTEST_SKIP() << kRealDataMissing;
#ifndef ARGMESH_TESTS_SUPPORT_REAL_DATA_H_
#define ARGMESH_TESTS_SUPPORT_REAL_DATA_H_

#include <filesystem>
#include <optional>
#include <string_view>

namespace argmesh {

inline constexpr char kRealDataMissing[] =
    "ARGMESH_DATA_DIR is not set or has no such folder: real meshes are not "
    "part of the project";

// $ARGMESH_DATA_DIR/<name> when it exists.
std::optional<std::filesystem::path> RealDataDir(std::string_view name);

}  // namespace argmesh

#endif  // ARGMESH_TESTS_SUPPORT_REAL_DATA_H_
