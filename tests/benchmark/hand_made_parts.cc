#include "tests/benchmark/hand_made_parts.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <sstream>
#include <utility>

#include "core/base/status_macros.h"
#include "tests/benchmark/labelled_collection.h"

namespace argmesh {

absl::StatusOr<HandMadeParts> ReadHandMadeParts(
    const std::filesystem::path& mesh_path, int num_faces) {
  const std::filesystem::path path =
      mesh_path.parent_path() / (mesh_path.stem().string() + "_parts.txt");
  ARGMESH_ASSIGN_OR_RETURN(const std::string text, ReadFile(path));
  HandMadeParts parts;
  parts.part_of_face.assign(static_cast<size_t>(num_faces), -1);
  std::istringstream lines(text);
  for (std::string name; std::getline(lines, name);) {
    std::string numbers;
    std::getline(lines, numbers);
    std::istringstream in(numbers);
    for (int face = 0; in >> face;) {
      if (face < 1 || face > num_faces) continue;
      parts.part_of_face[static_cast<size_t>(face) - 1] =
          static_cast<int32_t>(parts.names.size());
    }
    parts.names.push_back(name);
  }
  return parts;
}

std::vector<int32_t> ConnectedParts(const TriangleMesh& mesh,
                                    const std::vector<int32_t>& part_of_face) {
  std::vector<int32_t> root(part_of_face.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int32_t f) {
    while (root[static_cast<size_t>(f)] != f) f = root[static_cast<size_t>(f)];
    return f;
  };
  std::map<std::pair<int32_t, int32_t>, int32_t> face_of_edge;
  for (int f = 0; f < mesh.num_faces(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const auto edge = std::minmax(mesh.F(f, k), mesh.F(f, (k + 1) % 3));
      const auto [at, first] = face_of_edge.try_emplace(edge, f);
      if (first) continue;
      if (part_of_face[static_cast<size_t>(at->second)] !=
          part_of_face[static_cast<size_t>(f)]) {
        continue;
      }
      const int32_t a = find(at->second);
      const int32_t b = find(f);
      root[static_cast<size_t>(std::max(a, b))] = std::min(a, b);
    }
  }
  std::vector<int32_t> pieces(part_of_face.size(), -1);
  for (size_t f = 0; f < pieces.size(); ++f) {
    if (part_of_face[f] >= 0) pieces[f] = find(static_cast<int32_t>(f));
  }
  return pieces;
}

}  // namespace argmesh
