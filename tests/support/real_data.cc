#include "tests/support/real_data.h"

#include <cstdlib>

namespace argmesh {

std::optional<std::filesystem::path> RealDataDir(std::string_view name) {
  const char* root = std::getenv("ARGMESH_DATA_DIR");
  if (root == nullptr || *root == '\0') return std::nullopt;
  const std::filesystem::path dir = std::filesystem::path(root) / name;
  if (!std::filesystem::is_directory(dir)) return std::nullopt;
  return dir;
}

}  // namespace argmesh
