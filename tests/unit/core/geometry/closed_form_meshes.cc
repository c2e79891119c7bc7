#include "tests/unit/core/geometry/closed_form_meshes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <vector>

#include "core/base/random.h"

namespace argmesh {
namespace {

// Collects faces by position; equal positions (to 1e-7) are one vertex.
class MeshCollector {
 public:
  int32_t Vertex(const Eigen::Vector3d& p) {
    const std::array<int64_t, 3> key{std::llround(p.x() * 1e7),
                                     std::llround(p.y() * 1e7),
                                     std::llround(p.z() * 1e7)};
    const auto [it, inserted] =
        index_.emplace(key, static_cast<int32_t>(positions_.size()));
    if (inserted) positions_.push_back(p);
    return it->second;
  }

  void Face(int32_t a, int32_t b, int32_t c) { faces_.push_back({a, b, c}); }

  TriangleMesh Take() const {
    TriangleMesh mesh;
    mesh.V.resize(static_cast<Eigen::Index>(positions_.size()), 3);
    mesh.F.resize(static_cast<Eigen::Index>(faces_.size()), 3);
    for (int v = 0; v < mesh.num_vertices(); ++v) {
      mesh.V.row(v) = positions_.data()[v].transpose();
    }
    for (int f = 0; f < mesh.num_faces(); ++f) {
      for (int k = 0; k < 3; ++k) {
        mesh.F(f, k) = faces_.data()[f].data()[k];
      }
    }
    return mesh;
  }

 private:
  std::map<std::array<int64_t, 3>, int32_t> index_;
  std::vector<Eigen::Vector3d> positions_;
  std::vector<std::array<int32_t, 3>> faces_;
};

void AddTriangleGrid(const std::array<Eigen::Vector3d, 3>& corners, int steps,
                     MeshCollector& collector) {
  const auto at = [&](int i, int j) {
    return collector.Vertex(corners[0] + (corners[1] - corners[0]) * i / steps +
                            (corners[2] - corners[0]) * j / steps);
  };
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; i + j < steps; ++j) {
      collector.Face(at(i, j), at(i + 1, j), at(i, j + 1));
      if (i + j + 1 < steps) {
        collector.Face(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
    }
  }
}

// The quad origin + s u + t v, cut into nu x nv, normal u x v.
void AddQuadGrid(const Eigen::Vector3d& origin, const Eigen::Vector3d& u,
                 const Eigen::Vector3d& v, std::array<int, 2> steps,
                 MeshCollector& collector) {
  const auto at = [&](int i, int j) {
    return collector.Vertex(origin + u * i / steps[0] + v * j / steps[1]);
  };
  for (int i = 0; i < steps[0]; ++i) {
    for (int j = 0; j < steps[1]; ++j) {
      if ((i + j) % 2 == 0) {
        collector.Face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
        collector.Face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
      } else {
        collector.Face(at(i, j), at(i + 1, j), at(i, j + 1));
        collector.Face(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
    }
  }
}

}  // namespace

TriangleMesh MakeIcosphere(int frequency, double radius) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  const std::array<Eigen::Vector3d, 12> p{{{-1, g, 0},
                                           {1, g, 0},
                                           {-1, -g, 0},
                                           {1, -g, 0},
                                           {0, -1, g},
                                           {0, 1, g},
                                           {0, -1, -g},
                                           {0, 1, -g},
                                           {g, 0, -1},
                                           {g, 0, 1},
                                           {-g, 0, -1},
                                           {-g, 0, 1}}};
  constexpr std::array<std::array<size_t, 3>, 20> kFaces{
      {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
       {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
       {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
       {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};
  MeshCollector collector;
  for (const auto& f : kFaces) {
    AddTriangleGrid({p[f[0]], p[f[1]], p[f[2]]}, frequency, collector);
  }
  TriangleMesh mesh = collector.Take();
  mesh.V = (mesh.V.rowwise().normalized() * radius).eval();
  return mesh;
}

TriangleMesh MakeIrregularSphere(int frequency, double radius, uint64_t seed) {
  TriangleMesh mesh = MakeIcosphere(frequency, 1);
  Random random(seed);
  const double step = 0.25 * 1.1 / frequency;
  for (Eigen::Index i = 0; i < mesh.V.size(); ++i) {
    mesh.V.data()[i] += step * random.Uniform(-1, 1);
  }
  mesh.V = (mesh.V.rowwise().normalized() * radius).eval();
  return mesh;
}

TriangleMesh MakeTorus(double major_radius, double minor_radius,
                       int major_steps, int minor_steps) {
  TriangleMesh mesh;
  mesh.V.resize(major_steps * minor_steps, 3);
  mesh.F.resize(2 * major_steps * minor_steps, 3);
  const auto at = [&](int i, int j) {
    return (i % major_steps) * minor_steps + j % minor_steps;
  };
  int f = 0;
  for (int i = 0; i < major_steps; ++i) {
    for (int j = 0; j < minor_steps; ++j) {
      const double a = 2 * std::numbers::pi * i / major_steps;
      const double b = 2 * std::numbers::pi * j / minor_steps;
      const double r = major_radius + minor_radius * std::cos(b);
      mesh.V.row(at(i, j)) << r * std::cos(a), r * std::sin(a),
          minor_radius * std::sin(b);
      mesh.F.row(f++) << at(i, j), at(i + 1, j), at(i + 1, j + 1);
      mesh.F.row(f++) << at(i, j), at(i + 1, j + 1), at(i, j + 1);
    }
  }
  return mesh;
}

TriangleMesh MakeOpenCylinder(double radius, double height, int around,
                              int rings, bool staggered) {
  TriangleMesh mesh;
  mesh.V.resize(around * rings, 3);
  mesh.F.resize(2 * around * (rings - 1), 3);
  const auto at = [&](int ring, int i) { return ring * around + i % around; };
  int f = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const bool turned = staggered && ring % 2 == 1;
    for (int i = 0; i < around; ++i) {
      const double a = 2 * std::numbers::pi * (i + (turned ? 0.5 : 0)) / around;
      mesh.V.row(at(ring, i)) << radius * std::cos(a), radius * std::sin(a),
          height * ring / (rings - 1);
      if (ring + 1 == rings) continue;
      if (turned) {
        mesh.F.row(f++) << at(ring, i), at(ring + 1, i + 1), at(ring + 1, i);
        mesh.F.row(f++) << at(ring, i), at(ring, i + 1), at(ring + 1, i + 1);
      } else {
        mesh.F.row(f++) << at(ring, i), at(ring, i + 1), at(ring + 1, i);
        mesh.F.row(f++) << at(ring, i + 1), at(ring + 1, i + 1),
            at(ring + 1, i);
      }
    }
  }
  return mesh;
}

TriangleMesh MakeGrid(double size, int steps, uint64_t seed) {
  TriangleMesh mesh;
  mesh.V.resize((steps + 1) * (steps + 1), 3);
  mesh.F.resize(2 * steps * steps, 3);
  const auto at = [&](int i, int j) { return i * (steps + 1) + j; };
  Random random(seed);
  int f = 0;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps; ++j) {
      mesh.V.row(at(i, j)) << size * i / steps, size * j / steps, 0;
      if (i == steps || j == steps) continue;
      if (random.Below(2) == 0) {
        mesh.F.row(f++) << at(i, j), at(i + 1, j), at(i + 1, j + 1);
        mesh.F.row(f++) << at(i, j), at(i + 1, j + 1), at(i, j + 1);
      } else {
        mesh.F.row(f++) << at(i, j), at(i + 1, j), at(i, j + 1);
        mesh.F.row(f++) << at(i + 1, j), at(i + 1, j + 1), at(i, j + 1);
      }
    }
  }
  return mesh;
}

TriangleMesh MakeBox(const Eigen::Vector3d& extent, double spacing) {
  const auto steps = [&](int axis) {
    return std::max(1, static_cast<int>(std::lround(extent[axis] / spacing)));
  };
  MeshCollector collector;
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3;
    const int last = (axis + 2) % 3;
    const Eigen::Vector3d u = Eigen::Vector3d::Unit(next) * extent[next];
    const Eigen::Vector3d v = Eigen::Vector3d::Unit(last) * extent[last];
    AddQuadGrid(Eigen::Vector3d::Unit(axis) * extent[axis], u, v,
                {steps(next), steps(last)}, collector);
    AddQuadGrid(Eigen::Vector3d::Zero(), v, u, {steps(last), steps(next)},
                collector);
  }
  return collector.Take();
}

TriangleMesh Join(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh mesh;
  mesh.V.resize(a.V.rows() + b.V.rows(), 3);
  mesh.V << a.V, b.V;
  mesh.F.resize(a.F.rows() + b.F.rows(), 3);
  mesh.F << a.F, (b.F.array() + a.num_vertices()).matrix();
  return mesh;
}

TriangleMesh Moved(const TriangleMesh& mesh, const Eigen::Matrix3d& rotation,
                   double scale, const Eigen::Vector3d& offset) {
  TriangleMesh moved = mesh;
  moved.V =
      (scale * mesh.V * rotation.transpose()).rowwise() + offset.transpose();
  return moved;
}

Eigen::Matrix3d RandomRotation(uint64_t seed) {
  Random random(seed);
  Eigen::Quaterniond q(random.Normal(), random.Normal(), random.Normal(),
                       random.Normal());
  return q.normalized().toRotationMatrix();
}

VertexMatrix NormalsBy(
    const TriangleMesh& mesh,
    const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& normal) {
  VertexMatrix normals(mesh.num_vertices(), 3);
  for (int v = 0; v < mesh.num_vertices(); ++v) {
    normals.row(v) = normal(mesh.vertex(v)).normalized().transpose();
  }
  return normals;
}

}  // namespace argmesh
