// A folder of meshes with a labels.tsv, loaded and worked on in parallel.
#ifndef ARGMESH_TESTS_BENCHMARK_LABELLED_COLLECTION_H_
#define ARGMESH_TESTS_BENCHMARK_LABELLED_COLLECTION_H_

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct LabelledMesh {
  std::string path;  // relative to the folder
  std::string label;
};

// Rows of <folder>/labels.tsv: path, tab, class.
absl::StatusOr<std::vector<LabelledMesh>> ReadLabels(
    const std::filesystem::path& folder);

absl::StatusOr<std::string> ReadFile(const std::filesystem::path& path);

absl::StatusOr<TriangleMesh> ReadMesh(const std::filesystem::path& path);

// Calls body(i) for i = 0 .. count-1 on `threads` threads.
void ParallelFor(size_t count, int threads,
                 const std::function<void(size_t)>& body);

}  // namespace argmesh

#endif  // ARGMESH_TESTS_BENCHMARK_LABELLED_COLLECTION_H_
