// How well components agree with parts made by people, and how much of them
// comes back when the surface is changed; components and farthest-point cells
// on the same samples.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/abstraction/surface_abstraction.h"
#include "core/evaluation/segmentation.h"
#include "core/geometry/area.h"
#include "core/geometry/point_tree.h"
#include "tests/benchmark/hand_made_parts.h"
#include "tests/benchmark/labelled_collection.h"
#include "tests/benchmark/mesh_changes.h"

namespace argmesh {
namespace {

struct Options {
  std::string folder;
  std::string decomposition = "biharmonic";
  bool parts_only = false;
  int every = 1;
  int first = 0;
  int vertex_budget = 3000;
  int threads = 2;
};

// One segmentation of the samples of a surface.
struct Segmentation {
  std::string name;
  int segments = 0;
  std::vector<int32_t> of_sample;
};

struct Segmented {
  SurfaceAbstraction surface;
  std::vector<Segmentation> segmentations;
};

struct Mean {
  double sum = 0;
  double segments = 0;
  int count = 0;

  void Add(double value, int num_segments) {
    sum += value;
    segments += num_segments;
    ++count;
  }
};

// By what was measured, then by segmentation.
using Means = std::map<std::string, std::map<std::string, Mean>>;

std::string LevelName(const DecompositionLevel& level) {
  char name[32];
  if (level.count > 0) {
    std::snprintf(name, sizeof(name), "count-%d", level.count);
  } else {
    std::snprintf(name, sizeof(name), "ncut-%g", level.threshold);
  }
  return name;
}

void AddLevels(const Decomposition& decomposition, const std::string& prefix,
               std::vector<Segmentation>& out) {
  for (size_t l = 0; l < decomposition.levels.size(); ++l) {
    out.push_back({prefix + LevelName(decomposition.levels[l]),
                   decomposition.levels[l].num_components,
                   decomposition.ComponentOfSample(static_cast<int>(l))});
  }
}

absl::StatusOr<Segmented> Segment(const TriangleMesh& mesh,
                                  const Options& options) {
  AbstractionOptions abstraction;
  abstraction.resample.vertex_budget = options.vertex_budget;
  abstraction.decomposition =
      DecompositionOptionsFor(options.decomposition == "normal-curvature"
                                  ? DecompositionKind::kNormalCurvature
                                  : DecompositionKind::kBiharmonic);
  auto surface = AbstractSurface(mesh, abstraction);
  if (!surface.ok()) return surface.status();
  const DecompositionInput input = {surface->samples,
                                    surface->features,
                                    surface->edge_graph,
                                    surface->geodesic_graph,
                                    {}};
  DecompositionOptions cells =
      DecompositionOptionsFor(DecompositionKind::kVoronoi);
  cells.level_counts = {8, 10, 16};
  cells.voronoi_cells = 32;
  const auto voronoi = DecomposeSurface(input, cells);
  if (!voronoi.ok()) return voronoi.status();
  Segmented segmented;
  AddLevels(surface->decomposition, "", segmented.segmentations);
  AddLevels(*voronoi, "cells ", segmented.segmentations);
  segmented.surface = std::move(*surface);
  return segmented;
}

std::vector<int32_t> Select(const std::vector<int32_t>& labels,
                            const std::vector<int32_t>& samples) {
  std::vector<int32_t> selected;
  for (const int32_t v : samples) {
    selected.push_back(labels[static_cast<size_t>(v)]);
  }
  return selected;
}

void MeasureParts(const TriangleMesh& mesh, const HandMadeParts& parts,
                  const Segmented& segmented, Means& means) {
  const std::vector<int32_t> part = ConnectedParts(mesh, parts.part_of_face);
  const Eigen::VectorXd face_areas = ComputeFaceAreas(mesh);
  const std::vector<int32_t>& sample_of_face = segmented.surface.sample_of_face;
  std::vector<int32_t> samples, expected;
  std::vector<double> areas;
  for (size_t f = 0; f < part.size(); ++f) {
    if (sample_of_face[f] < 0 || part[f] < 0) continue;
    samples.push_back(sample_of_face[f]);
    expected.push_back(part[f]);
    areas.push_back(face_areas[static_cast<Eigen::Index>(f)]);
  }
  for (const Segmentation& s : segmented.segmentations) {
    const auto error =
        RandIndexError(Select(s.of_sample, samples), expected, areas);
    if (error.ok()) means["Rand error"][s.name].Add(*error, s.segments);
  }
}

// Where the samples of a surface lie in the mesh it was made from.
std::vector<Eigen::Vector3f> PositionsInMesh(const SurfaceAbstraction& surface,
                                             const Eigen::Affine3d& motion) {
  std::vector<Eigen::Vector3f> positions;
  for (int v = 0; v < surface.samples.num_vertices(); ++v) {
    const Eigen::Vector3d x =
        surface.samples.vertex(v) / surface.transform.scale +
        surface.transform.centroid;
    positions.push_back((motion * x).cast<float>());
  }
  return positions;
}

// Of every sample of `from` the nearest one of `to` whose normal agrees, at
// most a few sample distances away; -1 for those without one.
std::vector<int32_t> FindCounterparts(const Segmented& from,
                                      const Segmented& to,
                                      const Eigen::Affine3d& to_motion) {
  const std::vector<Eigen::Vector3f> queries =
      PositionsInMesh(from.surface, Eigen::Affine3d::Identity());
  const PointTree tree(PositionsInMesh(to.surface, to_motion));
  const Eigen::Matrix3d turn =
      to_motion.linear() / std::cbrt(to_motion.linear().determinant());
  const double radius = 0.08 / from.surface.transform.scale;
  std::vector<int32_t> counterparts(queries.size(), -1);
  for (size_t v = 0; v < queries.size(); ++v) {
    const Eigen::Vector3d normal =
        from.surface.features.normals.row(static_cast<Eigen::Index>(v));
    float nearest = std::numeric_limits<float>::max();
    tree.VisitBall(queries[v], static_cast<float>(radius),
                   [&](int32_t place, float squared) {
                     const int32_t u =
                         tree.numbers()[static_cast<size_t>(place)];
                     const Eigen::Vector3d other =
                         turn * to.surface.features.normals.row(u).transpose();
                     if (squared >= nearest || other.dot(normal) <= 0) return;
                     nearest = squared;
                     counterparts[v] = u;
                   });
  }
  return counterparts;
}

// The share of the area whose segment comes back; of a cut surface, of the
// segments of the whole within the cut.
void MeasureRepeatability(const Segmented& original, const Segmented& changed,
                          const Eigen::Affine3d& motion,
                          const std::string& name, Means& means) {
  const std::vector<int32_t> counterparts =
      FindCounterparts(changed, original, motion);
  std::vector<int32_t> here, there;
  std::vector<double> areas;
  for (size_t v = 0; v < counterparts.size(); ++v) {
    if (counterparts[v] < 0) continue;
    here.push_back(static_cast<int32_t>(v));
    there.push_back(counterparts[v]);
    areas.push_back(
        changed.surface.features.areas[static_cast<Eigen::Index>(v)]);
  }
  for (const Segmentation& s : original.segmentations) {
    for (const Segmentation& t : changed.segmentations) {
      if (s.name != t.name) continue;
      const auto share = Repeatability(Select(s.of_sample, there),
                                       Select(t.of_sample, here), areas);
      if (share.ok()) means[name][s.name].Add(*share, t.segments);
    }
  }
}

void MeasureMesh(const std::filesystem::path& path, uint64_t seed,
                 const Options& options, Means& means) {
  const auto mesh = ReadMesh(path);
  if (!mesh.ok()) return;
  const auto original = Segment(*mesh, options);
  if (!original.ok()) {
    std::printf("%s: %s\n", path.c_str(), original.status().ToString().c_str());
    return;
  }
  const auto parts = ReadHandMadeParts(path, mesh->num_faces());
  if (parts.ok()) MeasureParts(*mesh, *parts, *original, means);
  if (options.parts_only) return;
  std::vector<MeshChange> changes(WholeMeshChanges().begin(),
                                  WholeMeshChanges().end());
  changes.insert(changes.end(), HalfMeshChanges().begin(),
                 HalfMeshChanges().end());
  for (const MeshChange& change : changes) {
    const auto changed = Segment(change.apply(*mesh, seed), options);
    if (!changed.ok()) {
      std::printf("%s %s: %s\n", path.c_str(), change.name.c_str(),
                  changed.status().ToString().c_str());
      continue;
    }
    MeasureRepeatability(
        *original, *changed,
        change.moves ? MotionOf(*mesh, seed) : Eigen::Affine3d::Identity(),
        change.name, means);
  }
}

int Run(const Options& options) {
  const auto labels = ReadLabels(options.folder);
  if (!labels.ok()) {
    std::printf("%s\n", labels.status().ToString().c_str());
    return 1;
  }
  std::vector<size_t> chosen;
  for (auto i = static_cast<size_t>(options.first); i < labels->size();
       i += static_cast<size_t>(options.every)) {
    chosen.push_back(i);
  }
  std::vector<Means> of_mesh(chosen.size());
  ParallelFor(chosen.size(), options.threads, [&](size_t k) {
    MeasureMesh(
        std::filesystem::path(options.folder) / (*labels)[chosen[k]].path,
        chosen[k] + 1, options, of_mesh[k]);
  });
  Means means;
  for (const Means& one : of_mesh) {
    for (const auto& [what, values] : one) {
      for (const auto& [name, value] : values) {
        Mean& mean = means[what][name];
        mean.sum += value.sum;
        mean.segments += value.segments;
        mean.count += value.count;
      }
    }
  }
  for (const auto& [what, values] : means) {
    for (const auto& [name, mean] : values) {
      std::printf("%-13s %-15s %.3f  segments %.1f  meshes %d\n", what.c_str(),
                  name.c_str(), mean.sum / mean.count,
                  mean.segments / mean.count, mean.count);
    }
  }
  return 0;
}

}  // namespace
}  // namespace argmesh

int main(int argc, char** argv) {
  argmesh::Options options;
  CLI::App app(
      "Components against parts made by people and against themselves");
  app.add_option("folder", options.folder, "Meshes with a labels.tsv")
      ->required();
  app.add_option("--decomposition", options.decomposition)
      ->check(CLI::IsMember({"biharmonic", "normal-curvature"}));
  app.add_flag("--parts-only", options.parts_only,
               "No changed copies: Rand errors alone");
  app.add_option("--every", options.every, "Every n-th mesh")
      ->check(CLI::PositiveNumber);
  app.add_option("--first", options.first, "The first of them, from 0")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--vertex-budget", options.vertex_budget);
  app.add_option("--threads", options.threads);
  CLI11_PARSE(app, argc, argv);
  return argmesh::Run(options);
}
