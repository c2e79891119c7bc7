#include "core/synthesis/mesh_cut.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace argmesh {
namespace {

class Clipper {
 public:
  Clipper(const TriangleMesh& mesh, const CutPlane& plane) : mesh_(mesh) {
    heights_.reserve(static_cast<size_t>(mesh.num_vertices()));
    for (int v = 0; v < mesh.num_vertices(); ++v) {
      heights_.push_back(plane.normal.dot(mesh.vertex(v)) - plane.offset);
      points_.push_back(mesh.vertex(v));
    }
  }

  TriangleMesh Clip() && {
    for (int f = 0; f < mesh_.num_faces(); ++f) ClipFace(f);
    TriangleMesh part;
    part.V.resize(static_cast<Eigen::Index>(points_.size()), 3);
    for (size_t v = 0; v < points_.size(); ++v) {
      part.V.row(static_cast<Eigen::Index>(v)) = points_[v].transpose();
    }
    part.F.resize(static_cast<Eigen::Index>(faces_.size()), 3);
    for (size_t f = 0; f < faces_.size(); ++f) {
      part.F.row(static_cast<Eigen::Index>(f)) << faces_[f][0], faces_[f][1],
          faces_[f][2];
    }
    RemoveUnusedVertices(part);
    return part;
  }

 private:
  double Height(int32_t v) const { return heights_[static_cast<size_t>(v)]; }

  // Sutherland-Hodgman on one triangle.
  void ClipFace(int f) {
    std::vector<int32_t> polygon;
    for (int k = 0; k < 3; ++k) {
      const int32_t a = mesh_.F(f, k);
      const int32_t b = mesh_.F(f, (k + 1) % 3);
      if (Height(a) >= 0) polygon.push_back(a);
      // A vertex on the plane is kept itself, so its edges need no point.
      if ((Height(a) > 0 && Height(b) < 0) ||
          (Height(a) < 0 && Height(b) > 0)) {
        polygon.push_back(PointOnEdge(a, b));
      }
    }
    for (size_t i = 2; i < polygon.size(); ++i) {
      faces_.push_back({polygon[0], polygon[i - 1], polygon[i]});
    }
  }

  int32_t PointOnEdge(int32_t a, int32_t b) {
    if (a > b) std::swap(a, b);
    const auto [it, is_new] = point_on_edge_.try_emplace(
        {a, b}, static_cast<int32_t>(points_.size()));
    if (is_new) {
      const double t = Height(a) / (Height(a) - Height(b));
      points_.push_back((1 - t) * mesh_.vertex(a) + t * mesh_.vertex(b));
    }
    return it->second;
  }

  const TriangleMesh& mesh_;
  std::vector<double> heights_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::array<int32_t, 3>> faces_;
  std::map<std::pair<int32_t, int32_t>, int32_t> point_on_edge_;
};

}  // namespace

TriangleMesh CutByPlane(const TriangleMesh& mesh, const CutPlane& plane) {
  return Clipper(mesh, plane).Clip();
}

TriangleMesh CutHalf(const TriangleMesh& mesh, int axis) {
  if (mesh.num_vertices() == 0) return mesh;
  CutPlane plane{.normal = Eigen::Vector3d::Unit(axis)};
  plane.offset =
      0.5 * (mesh.V.col(axis).minCoeff() + mesh.V.col(axis).maxCoeff());
  return CutByPlane(mesh, plane);
}

}  // namespace argmesh
