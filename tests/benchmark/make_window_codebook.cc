// Makes core/containment/window_codebook.bin: from every second mesh of
// labelled folders (the 1st, 3rd .. of labels.tsv) and from sample shapes.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "core/base/status_macros.h"
#include "core/containment/window_extraction.h"
#include "core/mesh/mesh_repair.h"
#include "core/synthesis/sample_collection.h"
#include "tests/benchmark/codebook_training.h"
#include "tests/benchmark/labelled_collection.h"

namespace argmesh {
namespace {

struct Options {
  std::vector<std::string> folders;
  std::string out;
  int limit = 240;  // meshes of a folder
  int samples_per_class = 4;
  int threads = 2;
};

absl::StatusOr<TrainingShape> Describe(const TriangleMesh& mesh) {
  ARGMESH_ASSIGN_OR_RETURN(const RepairedMesh repaired, RepairMesh(mesh));
  ARGMESH_ASSIGN_OR_RETURN(
      const RawWindowSet raw,
      ExtractRawWindows(repaired.mesh, TargetPlan(800, 1)));
  TrainingShape shape;
  for (size_t l = 0; l < shape.size(); ++l) {
    for (const DescribedWindow& window : raw.levels[l].windows) {
      shape[l].push_back(window.raw);
    }
  }
  return shape;
}

absl::StatusOr<std::vector<TriangleMesh>> ReadTraining(const Options& options) {
  std::vector<TriangleMesh> meshes;
  for (const std::string& folder : options.folders) {
    ARGMESH_ASSIGN_OR_RETURN(const std::vector<LabelledMesh> items,
                             ReadLabels(folder));
    int taken = 0;
    for (size_t i = 0; i < items.size() && taken < options.limit; i += 2) {
      ARGMESH_ASSIGN_OR_RETURN(
          TriangleMesh mesh,
          ReadMesh(std::filesystem::path(folder) / items[i].path));
      meshes.push_back(std::move(mesh));
      ++taken;
    }
  }
  SampleCollectionOptions samples;
  samples.shapes_per_class = options.samples_per_class;
  ARGMESH_RETURN_IF_ERROR(
      MakeSampleCollection(samples, [&meshes](SampleItem item) {
        meshes.push_back(std::move(item.mesh));
        return absl::OkStatus();
      }));
  return meshes;
}

absl::Status Run(const Options& options) {
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<TriangleMesh> meshes,
                           ReadTraining(options));
  std::vector<TrainingShape> shapes(meshes.size());
  std::vector<absl::Status> statuses(meshes.size());
  ParallelFor(meshes.size(), options.threads, [&](size_t i) {
    absl::StatusOr<TrainingShape> shape = Describe(meshes[i]);
    statuses[i] = shape.status();
    if (shape.ok()) shapes[i] = *std::move(shape);
  });
  for (const absl::Status& status : statuses) ARGMESH_RETURN_IF_ERROR(status);
  const WindowCodebook codebook =
      TrainWindowCodebook(shapes, /*seed=*/1, options.threads);
  const std::string bytes = SerializeWindowCodebook(codebook);
  std::ofstream(options.out, std::ios::binary) << bytes;
  std::printf("%zu shapes, unit %.0f, %zu bytes\n", shapes.size(),
              static_cast<double>(codebook.unit), bytes.size());
  return absl::OkStatus();
}

}  // namespace
}  // namespace argmesh

int main(int argc, char** argv) {
  argmesh::Options options;
  CLI::App app("The codebook of windows");
  app.add_option("out", options.out, "File to write")->required();
  app.add_option("folders", options.folders, "Meshes with a labels.tsv");
  app.add_option("--limit", options.limit, "Meshes of each folder");
  app.add_option("--samples", options.samples_per_class,
                 "Sample shapes of each class");
  app.add_option("--threads", options.threads);
  CLI11_PARSE(app, argc, argv);
  const absl::Status status = argmesh::Run(options);
  if (!status.ok()) std::printf("%s\n", status.ToString().c_str());
  return status.ok() ? 0 : 1;
}
