// Segmentations made by people: files that hold, for each part, a line with
// its name and a line of face numbers from 1.
#ifndef ARGMESH_TESTS_BENCHMARK_HAND_MADE_PARTS_H_
#define ARGMESH_TESTS_BENCHMARK_HAND_MADE_PARTS_H_

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct HandMadeParts {
  std::vector<std::string> names;
  std::vector<int32_t> part_of_face;  // -1 for faces no part names
};

// "cup/21.off" has "cup/21_parts.txt" beside it.
absl::StatusOr<HandMadeParts> ReadHandMadeParts(
    const std::filesystem::path& mesh_path, int num_faces);

// Parts split into their connected pieces: a part name like "leg" stands for
// all legs. -1 stays -1.
std::vector<int32_t> ConnectedParts(const TriangleMesh& mesh,
                                    const std::vector<int32_t>& part_of_face);

}  // namespace argmesh

#endif  // ARGMESH_TESTS_BENCHMARK_HAND_MADE_PARTS_H_
