// Writes changed copies of a labelled folder, with a labels.tsv and a
// queries.tsv (path, class, source) for `argmesh evaluate --queries`.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "core/base/status_macros.h"
#include "core/geometry/area.h"
#include "core/mesh/mesh_format.h"
#include "core/mesh/mesh_repair.h"
#include "core/mesh/mesh_resample.h"
#include "core/mesh/mesh_write.h"
#include "core/synthesis/mesh_cut.h"
#include "core/synthesis/mesh_decimate.h"
#include "core/synthesis/mesh_noise.h"
#include "core/synthesis/mesh_similarity.h"
#include "tests/benchmark/cut_pieces.h"
#include "tests/benchmark/hand_made_parts.h"
#include "tests/benchmark/labelled_collection.h"

namespace argmesh {
namespace {

struct Options {
  std::string in, out;
  std::string only;           // paths that begin so; empty: all
  std::string source_prefix;  // sources: the paths of the same class below
  uint64_t seed = 1;
  int every = 1;
  int resample = 0;
  double noise = 0;
  double size_noise = 0;
  double decimate = 0;
  int half_axis = -1;
  double piece = 0;     // share of the area
  int piece_axis = -1;  // a random direction when negative
  double disc = 0;      // radius in square roots of the area
  bool similarity = false;
  bool parts = false;
  double min_part_area = 0.02;  // shares of the shape
  double max_part_area = 1;
};

struct Variant {
  std::string path;  // relative
  std::string label;
  std::string source;
  TriangleMesh mesh;
};

constexpr uint64_t kSeedsPerItem = 1000;
constexpr int kMinFaces = 20;  // of a piece that is worth looking for

TriangleMesh Cut(TriangleMesh mesh, const Options& options, uint64_t seed) {
  if (options.half_axis >= 0) mesh = CutHalf(mesh, options.half_axis);
  if (options.piece > 0) {
    mesh = CutByShare(mesh,
                      options.piece_axis < 0
                          ? RandomDirection(seed)
                          : Eigen::Vector3d::Unit(options.piece_axis),
                      options.piece);
  }
  if (options.disc > 0) mesh = FlattestDisc(mesh, options.disc, seed);
  return mesh;
}

absl::StatusOr<TriangleMesh> Change(TriangleMesh mesh, const Options& options,
                                    uint64_t seed) {
  mesh = Cut(std::move(mesh), options, seed);
  if (options.resample > 0 && mesh.num_faces() > 0) {
    ARGMESH_ASSIGN_OR_RETURN(const RepairedMesh repaired, RepairMesh(mesh));
    ResampleOptions resample;
    resample.vertex_budget = options.resample;
    ARGMESH_ASSIGN_OR_RETURN(ResampledMesh resampled,
                             ResampleMesh(repaired.mesh, resample));
    mesh = std::move(resampled.mesh);
  }
  if (options.noise > 0) mesh = AddNoise(mesh, options.noise, seed);
  if (options.size_noise > 0 && mesh.num_faces() > 0) {
    const double diagonal =
        (mesh.V.colwise().maxCoeff() - mesh.V.colwise().minCoeff()).norm();
    const double size = std::sqrt(ComputeFaceAreas(mesh).sum());
    mesh = AddNoise(mesh, options.size_noise * size / diagonal, seed);
  }
  if (options.decimate > 0) {
    mesh = DecimateMesh(
        mesh, static_cast<int>(options.decimate * mesh.num_vertices()));
  }
  if (options.similarity) mesh = RandomSimilarity(mesh, seed);
  return mesh;
}

// Faces of the largest connected piece of each named part.
std::vector<Variant> CutParts(const LabelledMesh& item,
                              const TriangleMesh& mesh,
                              const HandMadeParts& parts,
                              const Options& options) {
  const std::vector<int32_t> pieces = ConnectedParts(mesh, parts.part_of_face);
  const Eigen::VectorXd areas = ComputeFaceAreas(mesh);
  std::vector<Variant> variants;
  for (size_t p = 0; p < parts.names.size(); ++p) {
    std::vector<double> piece_area(pieces.size(), 0);
    for (size_t f = 0; f < pieces.size(); ++f) {
      if (parts.part_of_face[f] != static_cast<int32_t>(p)) continue;
      piece_area[static_cast<size_t>(pieces[f])] +=
          areas[static_cast<Eigen::Index>(f)];
    }
    const auto largest = std::max_element(piece_area.begin(), piece_area.end());
    if (largest == piece_area.end() ||
        *largest < options.min_part_area * areas.sum() ||
        *largest > options.max_part_area * areas.sum()) {
      continue;
    }
    const auto root = static_cast<int32_t>(largest - piece_area.begin());
    std::vector<Eigen::Index> kept;
    for (size_t f = 0; f < pieces.size(); ++f) {
      if (pieces[f] == root) kept.push_back(static_cast<Eigen::Index>(f));
    }
    Variant variant;
    const std::filesystem::path path(item.path);
    variant.path = (path.parent_path() / path.stem()).string() + "_" +
                   std::to_string(p) + ".off";
    variant.label = item.label;
    variant.source = item.path;
    variant.mesh.V = mesh.V;
    variant.mesh.F = mesh.F(kept, Eigen::all);
    RemoveUnusedVertices(variant.mesh);
    variants.push_back(std::move(variant));
  }
  return variants;
}

absl::StatusOr<std::vector<Variant>> MakeVariants(const LabelledMesh& item,
                                                  const Options& options,
                                                  uint64_t seed) {
  const std::filesystem::path path =
      std::filesystem::path(options.in) / item.path;
  ARGMESH_ASSIGN_OR_RETURN(TriangleMesh mesh, ReadMesh(path));
  std::vector<Variant> variants;
  if (options.parts) {
    ARGMESH_ASSIGN_OR_RETURN(const HandMadeParts parts,
                             ReadHandMadeParts(path, mesh.num_faces()));
    variants = CutParts(item, mesh, parts, options);
  } else {
    variants.push_back({item.path, item.label, item.path, std::move(mesh)});
  }
  for (Variant& variant : variants) {
    ARGMESH_ASSIGN_OR_RETURN(variant.mesh,
                             Change(std::move(variant.mesh), options, seed++));
  }
  std::erase_if(variants, [](const Variant& variant) {
    return variant.mesh.num_faces() < kMinFaces;
  });
  return variants;
}

// The item of the same class below options.source_prefix.
std::string SourceOf(const Variant& variant,
                     const std::vector<LabelledMesh>& items,
                     const Options& options) {
  if (options.source_prefix.empty()) return variant.source;
  for (const LabelledMesh& item : items) {
    if (item.label == variant.label &&
        item.path.starts_with(options.source_prefix)) {
      return item.path;
    }
  }
  return "";
}

absl::Status Write(const Variant& variant, const Options& options,
                   std::ofstream& labels, std::ofstream& queries) {
  const std::filesystem::path path =
      std::filesystem::path(options.out) / variant.path;
  std::filesystem::create_directories(path.parent_path());
  ARGMESH_ASSIGN_OR_RETURN(const std::string bytes,
                           SerializeMesh(variant.mesh, MeshFormat::kOff));
  std::ofstream(path, std::ios::binary) << bytes;
  labels << variant.path << '\t' << variant.label << '\n';
  queries << variant.path << '\t' << variant.label << '\t' << variant.source
          << '\n';
  return absl::OkStatus();
}

absl::Status Run(const Options& options) {
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<LabelledMesh> items,
                           ReadLabels(options.in));
  std::filesystem::create_directories(options.out);
  const std::filesystem::path out(options.out);
  std::ofstream labels(out / "labels.tsv");
  std::ofstream queries(out / "queries.tsv");
  for (size_t i = 0; i < items.size();
       i += static_cast<size_t>(options.every)) {
    if (!items[i].path.starts_with(options.only)) continue;
    ARGMESH_ASSIGN_OR_RETURN(
        std::vector<Variant> variants,
        MakeVariants(items[i], options, kSeedsPerItem * (options.seed + i)));
    for (Variant& variant : variants) {
      variant.source = SourceOf(variant, items, options);
      ARGMESH_RETURN_IF_ERROR(Write(variant, options, labels, queries));
    }
  }
  return absl::OkStatus();
}

}  // namespace
}  // namespace argmesh

int main(int argc, char** argv) {
  argmesh::Options options;
  CLI::App app("Changed copies of a labelled folder");
  app.add_option("in", options.in, "Meshes with a labels.tsv")->required();
  app.add_option("out", options.out, "Folder to write")->required();
  app.add_option("--every", options.every, "Every n-th mesh only");
  app.add_option("--resample", options.resample, "Vertices of every copy");
  app.add_option("--noise", options.noise, "Share of the box diagonal");
  app.add_option("--size-noise", options.size_noise,
                 "Share of the square root of the area");
  app.add_option("--decimate", options.decimate, "Share of vertices kept");
  app.add_option("--half", options.half_axis, "Cut in half on axis 0, 1, 2");
  app.add_option("--piece", options.piece,
                 "Cut off by a plane: share of the area that is kept");
  app.add_option("--piece-axis", options.piece_axis,
                 "Axis of that plane's normal instead of a random one");
  app.add_option("--disc", options.disc,
                 "A featureless patch: radius in square roots of the area");
  app.add_option("--only", options.only, "Paths that begin so");
  app.add_option("--source-prefix", options.source_prefix,
                 "Name as source the path of the same class that begins so");
  app.add_option("--seed", options.seed);
  app.add_flag("--similarity", options.similarity,
               "Random rotation, scale, translation and numbering");
  app.add_flag("--parts", options.parts, "Hand-made parts, one file each");
  app.add_option("--min-part-area", options.min_part_area);
  app.add_option("--max-part-area", options.max_part_area);
  CLI11_PARSE(app, argc, argv);
  const absl::Status status = argmesh::Run(options);
  if (!status.ok()) std::printf("%s\n", status.ToString().c_str());
  return status.ok() ? 0 : 1;
}
