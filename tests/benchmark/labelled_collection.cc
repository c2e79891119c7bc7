#include "tests/benchmark/labelled_collection.h"

#include <atomic>
#include <fstream>
#include <sstream>
#include <thread>

#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "core/mesh/mesh_format.h"

namespace argmesh {

absl::StatusOr<std::string> ReadFile(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    return absl::NotFoundError(
        absl::StrFormat("%s cannot be read", path.string()));
  }
  std::ostringstream bytes;
  bytes << in.rdbuf();
  return std::move(bytes).str();
}

absl::StatusOr<std::vector<LabelledMesh>> ReadLabels(
    const std::filesystem::path& folder) {
  ARGMESH_ASSIGN_OR_RETURN(const std::string text,
                           ReadFile(folder / "labels.tsv"));
  std::vector<LabelledMesh> meshes;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const size_t tab = line.find('\t');
    if (tab == std::string::npos) continue;
    meshes.push_back({line.substr(0, tab), line.substr(tab + 1)});
  }
  return meshes;
}

absl::StatusOr<TriangleMesh> ReadMesh(const std::filesystem::path& path) {
  ARGMESH_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path));
  ARGMESH_ASSIGN_OR_RETURN(ParsedMesh parsed,
                           ParseMesh(bytes, MeshFormatFromPath(path.string())));
  return std::move(parsed.mesh);
}

void ParallelFor(size_t count, int threads,
                 const std::function<void(size_t)>& body) {
  std::atomic<size_t> next = 0;
  std::vector<std::jthread> workers;
  for (int t = 0; t < threads; ++t) {
    workers.emplace_back([&] {
      for (size_t i = next++; i < count; i = next++) body(i);
    });
  }
}

}  // namespace argmesh
