#include "tests/support/test_meshes.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/base/random.h"
#include "core/mesh/mesh_weld.h"

namespace argmesh {
namespace {

constexpr double kTau = 2 * std::numbers::pi;

std::vector<int32_t> Shuffled(int n, Random& random) {
  std::vector<int32_t> order(static_cast<size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  for (size_t i = order.size(); i > 1; --i) {
    std::swap(order[i - 1], order[random.Below(i)]);
  }
  return order;
}

}  // namespace

TriangleMesh MakeRevolution(const std::vector<Eigen::Vector2d>& profile,
                            int segments) {
  const auto rings = static_cast<int>(profile.size()) - 2;
  TriangleMesh mesh;
  mesh.V.resize(rings * segments + 2, 3);
  for (int i = 0; i < rings; ++i) {
    const Eigen::Vector2d& p = profile[static_cast<size_t>(i) + 1];
    for (int s = 0; s < segments; ++s) {
      const double angle = kTau * (s + 0.5 * (i % 2)) / segments;
      mesh.V.row(i * segments + s) << p.y() * std::cos(angle),
          p.y() * std::sin(angle), p.x();
    }
  }
  const int bottom = rings * segments;
  const int top = bottom + 1;
  mesh.V.row(bottom) << 0, 0, profile.front().x();
  mesh.V.row(top) << 0, 0, profile.back().x();
  std::vector<Eigen::Vector3i> faces;
  for (int s = 0; s < segments; ++s) {
    const int t = (s + 1) % segments;
    faces.emplace_back(bottom, t, s);
    const int last = (rings - 1) * segments;
    faces.emplace_back(top, last + s, last + t);
    for (int i = 0; i + 1 < rings; ++i) {
      const int a = i * segments;
      const int b = a + segments;
      if (i % 2 == 0) {
        faces.emplace_back(a + s, a + t, b + s);
        faces.emplace_back(a + t, b + t, b + s);
      } else {
        faces.emplace_back(a + s, b + t, b + s);
        faces.emplace_back(a + s, a + t, b + t);
      }
    }
  }
  mesh.F.resize(static_cast<Eigen::Index>(faces.size()), 3);
  for (size_t f = 0; f < faces.size(); ++f) {
    mesh.F.row(static_cast<Eigen::Index>(f)) = faces[f].transpose();
  }
  return mesh;
}

TriangleMesh MakeDumbbell(int segments) {
  constexpr int kSteps = 24;
  constexpr double kNeck = 0.15;
  const double join = std::asin(kNeck);  // where the ball meets the neck
  std::vector<Eigen::Vector2d> profile;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle =
        std::numbers::pi - (std::numbers::pi - join) * i / kSteps;
    profile.emplace_back(-2 + std::cos(angle), std::sin(angle));
  }
  const double end = profile.back().x();
  for (int i = 1; i < kSteps; ++i) {
    profile.emplace_back(end - 2 * end * i / kSteps, kNeck);
  }
  for (int i = 0; i <= kSteps; ++i) {
    const double angle =
        std::numbers::pi - join - (std::numbers::pi - join) * i / kSteps;
    profile.emplace_back(2 + std::cos(angle), std::sin(angle));
  }
  return MakeRevolution(profile, segments);
}

TriangleMesh MakeTorus(double major_radius, double minor_radius, int major,
                       int minor) {
  TriangleMesh mesh;
  mesh.V.resize(major * minor, 3);
  mesh.F.resize(2 * major * minor, 3);
  for (int i = 0; i < major; ++i) {
    for (int j = 0; j < minor; ++j) {
      const double u = kTau * i / major;
      const double v = kTau * j / minor;
      const double ring = major_radius + minor_radius * std::cos(v);
      const int at = i * minor + j;
      mesh.V.row(at) << ring * std::cos(u), ring * std::sin(u),
          minor_radius * std::sin(v);
      const int right = ((i + 1) % major) * minor + j;
      const int up = i * minor + (j + 1) % minor;
      const int both = ((i + 1) % major) * minor + (j + 1) % minor;
      mesh.F.row(2 * at) << at, right, both;
      mesh.F.row(2 * at + 1) << at, both, up;
    }
  }
  return mesh;
}

TriangleMesh MakeSheet(int n) {
  TriangleMesh mesh;
  mesh.V.resize((n + 1) * (n + 1), 3);
  mesh.F.resize(2 * n * n, 3);
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) {
      mesh.V.row(y * (n + 1) + x) << static_cast<double>(x) / n,
          static_cast<double>(y) / n, 0;
    }
  }
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const int a = y * (n + 1) + x;
      const int c = a + n + 1;
      mesh.F.row(2 * (y * n + x)) << a, a + 1, c + 1;
      mesh.F.row(2 * (y * n + x) + 1) << a, c + 1, c;
    }
  }
  return mesh;
}

TriangleMesh Join(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh mesh;
  mesh.V.resize(a.V.rows() + b.V.rows(), 3);
  mesh.V << a.V, b.V;
  mesh.F.resize(a.F.rows() + b.F.rows(), 3);
  mesh.F << a.F, (b.F.array() + a.num_vertices()).matrix();
  return mesh;
}

TriangleMesh Translated(TriangleMesh mesh, const Eigen::Vector3d& by) {
  mesh.V.rowwise() += by.transpose();
  return mesh;
}

TriangleMesh RandomlyMoved(const TriangleMesh& mesh, uint64_t seed) {
  Random random(seed);
  const Eigen::Quaterniond rotation =
      Eigen::Quaterniond(random.Normal(), random.Normal(), random.Normal(),
                         random.Normal())
          .normalized();
  const double scale = std::exp(random.Uniform(std::log(0.2), std::log(5.0)));
  const Eigen::RowVector3d shift(random.Normal(), random.Normal(),
                                 random.Normal());
  const std::vector<int32_t> vertex_to = Shuffled(mesh.num_vertices(), random);
  const std::vector<int32_t> face_to = Shuffled(mesh.num_faces(), random);
  TriangleMesh moved = mesh;
  for (int v = 0; v < mesh.num_vertices(); ++v) {
    moved.V.row(vertex_to[static_cast<size_t>(v)]) =
        scale * (rotation * mesh.vertex(v)).transpose() + shift;
  }
  for (int f = 0; f < mesh.num_faces(); ++f) {
    for (int k = 0; k < 3; ++k) {
      moved.F(face_to[static_cast<size_t>(f)], k) =
          vertex_to[static_cast<size_t>(mesh.F(f, k))];
    }
  }
  return moved;
}

double Area(const TriangleMesh& mesh) {
  double area = 0;
  for (int f = 0; f < mesh.num_faces(); ++f) {
    area += FaceCross(mesh, f).norm() / 2;
  }
  return area;
}

}  // namespace argmesh
