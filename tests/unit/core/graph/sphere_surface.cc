#include "tests/unit/core/graph/sphere_surface.h"

#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "core/geometry/area.h"
#include "core/geometry/surface_graph.h"

namespace argmesh {
namespace {

using Points = std::vector<Eigen::Vector3d>;
using Triangles = std::vector<Eigen::Vector3i>;

void Subdivide(Points& points, Triangles& triangles) {
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto key = std::minmax(a, b);
    const auto [it, added] =
        middles.try_emplace({key.first, key.second}, int(points.size()));
    if (added) {
      const Eigen::Vector3d sum =
          points[static_cast<size_t>(a)] + points[static_cast<size_t>(b)];
      points.push_back(sum.normalized());
    }
    return it->second;
  };
  Triangles finer;
  for (const Eigen::Vector3i& t : triangles) {
    const int ab = middle(t[0], t[1]);
    const int bc = middle(t[1], t[2]);
    const int ca = middle(t[2], t[0]);
    finer.emplace_back(t[0], ab, ca);
    finer.emplace_back(t[1], bc, ab);
    finer.emplace_back(t[2], ca, bc);
    finer.emplace_back(ab, bc, ca);
  }
  triangles = std::move(finer);
}

TriangleMesh MakeOctaSphere(int subdivisions) {
  Points points = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                   {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
  Triangles triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                         {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int s = 0; s < subdivisions; ++s) Subdivide(points, triangles);
  TriangleMesh mesh;
  mesh.V.resize(static_cast<Eigen::Index>(points.size()), 3);
  mesh.F.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (size_t v = 0; v < points.size(); ++v) {
    mesh.V.row(static_cast<Eigen::Index>(v)) =
        kSphereRadius * points[v].transpose();
  }
  for (size_t f = 0; f < triangles.size(); ++f) {
    mesh.F.row(static_cast<Eigen::Index>(f)) = triangles[f].transpose();
  }
  return mesh;
}

SurfaceFeatures SphereFeatures(const TriangleMesh& mesh) {
  const Eigen::Index n = mesh.V.rows();
  SurfaceFeatures features;
  features.areas = ComputeVertexAreas(mesh);
  features.areas /= features.areas.sum();
  features.normals = mesh.V / kSphereRadius;
  features.mean_curvature.setConstant(n, 1 / kSphereRadius);
  features.gauss_curvature.setConstant(n, 4 * std::numbers::pi);
  features.shape_diameter.setConstant(n, 0.5);
  features.average_geodesic.setConstant(n,
                                        kSphereRadius * std::numbers::pi / 2);
  features.wave_kernel.setConstant(n, 16, 1.0);
  return features;
}

}  // namespace

SurfaceAbstraction MakeSphereSurface(int subdivisions) {
  SurfaceAbstraction surface;
  surface.samples = MakeOctaSphere(subdivisions);
  surface.transform.centroid = {1, 2, 3};
  surface.transform.scale = 0.5;
  surface.edge_graph = BuildSurfaceGraph(surface.samples, {.diagonals = false});
  surface.geodesic_graph = BuildSurfaceGraph(surface.samples);
  surface.features = SphereFeatures(surface.samples);
  Decomposition& decomposition = surface.decomposition;
  for (int v = 0; v < surface.samples.num_vertices(); ++v) {
    const Eigen::Vector3d p = surface.samples.vertex(v);
    const int quadrant = 2 * (p.y() < 0 ? 1 : 0) + (p.x() < 0 ? 1 : 0);
    decomposition.region_of_sample.push_back(4 * (p.z() < 0 ? 1 : 0) +
                                             quadrant);
    surface.uniform_cell_of_sample.push_back(quadrant);
  }
  surface.num_uniform_cells = 4;
  decomposition.num_regions = 8;
  decomposition.levels = {
      {1.6, 0, 2, {0, 0, 0, 0, 1, 1, 1, 1}, {-1, -1}},
      {0, 16, 8, {0, 1, 2, 3, 4, 5, 6, 7}, {0, 0, 0, 0, 1, 1, 1, 1}}};
  decomposition.modes = {{.sample = 4,
                          .window = 0.05F,
                          .repeatability = 3,
                          .density = 0.5F,
                          .offset = 0.1F,
                          .region = 5}};
  surface.sample_of_face.assign(5, 4);
  surface.sample_of_face[1] = -1;
  surface.sample_of_face[2] = 5;
  return surface;
}

}  // namespace argmesh
