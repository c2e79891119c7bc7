#include "core/synthesis/mesh_decimate.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

namespace argmesh {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

struct Candidate {
  double cost = 0;
  int32_t a = 0;    // stays, a < b
  int32_t b = 0;    // goes
  int32_t age = 0;  // sum of both vertices' changes when it was made

  bool operator>(const Candidate& other) const {
    return std::tie(cost, a, b, age) >
           std::tie(other.cost, other.a, other.b, other.age);
  }
};

class Decimator {
 public:
  explicit Decimator(const TriangleMesh& mesh) : mesh_(mesh) {
    const auto n = static_cast<size_t>(mesh.num_vertices());
    quadrics_.assign(n, Eigen::Matrix4d::Zero());
    faces_of_.resize(n);
    age_.assign(n, 0);
    alive_.assign(static_cast<size_t>(mesh.num_faces()), true);
    for (int f = 0; f < mesh.num_faces(); ++f) AddFace(f);
    for (int32_t v = 0; v < mesh.num_vertices(); ++v) {
      if (!faces_of_[static_cast<size_t>(v)].empty()) ++num_vertices_;
      PushEdges(v, true);
    }
  }

  TriangleMesh Run(int target_vertices) && {
    while (num_vertices_ > target_vertices && !queue_.empty()) {
      const Candidate next = queue_.top();
      queue_.pop();
      if (next.age != Age(next.a, next.b)) continue;
      const Vector3d place = Place(next.a, next.b);
      if (CanCollapse(next.a, next.b, place)) {
        Collapse(next.a, next.b, place);
      }
    }
    TriangleMesh result;
    result.V = mesh_.V;
    result.F.resize(std::count(alive_.begin(), alive_.end(), true), 3);
    Eigen::Index row = 0;
    for (int f = 0; f < mesh_.num_faces(); ++f) {
      if (alive_[static_cast<size_t>(f)]) result.F.row(row++) = mesh_.F.row(f);
    }
    RemoveUnusedVertices(result);
    return result;
  }

 private:
  const std::vector<int32_t>& FacesOf(int32_t v) const {
    return faces_of_[static_cast<size_t>(v)];
  }
  int32_t Age(int32_t a, int32_t b) const {
    return age_[static_cast<size_t>(a)] + age_[static_cast<size_t>(b)];
  }

  void AddFace(int f) {
    const Vector3d a = mesh_.vertex(mesh_.F(f, 0));
    const Vector3d cross = (mesh_.vertex(mesh_.F(f, 1)) - a)
                               .cross(mesh_.vertex(mesh_.F(f, 2)) - a);
    const double area2 = cross.norm();
    Vector4d plane = Vector4d::Zero();
    if (area2 > 0) {
      const Vector3d normal = cross / area2;
      plane << normal, -normal.dot(a);
    }
    for (int k = 0; k < 3; ++k) {
      const auto v = static_cast<size_t>(mesh_.F(f, k));
      quadrics_[v] += area2 * plane * plane.transpose();
      faces_of_[v].push_back(f);
    }
  }

  // Ascending, each once.
  std::vector<int32_t> Neighbors(int32_t v) const {
    std::vector<int32_t> neighbors;
    for (const int32_t f : FacesOf(v)) {
      for (int k = 0; k < 3; ++k) {
        if (mesh_.F(f, k) != v) neighbors.push_back(mesh_.F(f, k));
      }
    }
    std::sort(neighbors.begin(), neighbors.end());
    neighbors.erase(std::unique(neighbors.begin(), neighbors.end()),
                    neighbors.end());
    return neighbors;
  }

  // A fan is closed when it has as many faces as neighbours.
  bool IsInner(int32_t v) const {
    return FacesOf(v).size() == Neighbors(v).size();
  }

  void PushEdges(int32_t v, bool upward_only) {
    for (const int32_t w : Neighbors(v)) {
      if (upward_only && w < v) continue;
      const int32_t a = std::min(v, w);
      const int32_t b = std::max(v, w);
      queue_.push({Cost(a, b, Place(a, b)), a, b, Age(a, b)});
    }
  }

  Eigen::Matrix4d Quadric(int32_t a, int32_t b) const {
    return quadrics_[static_cast<size_t>(a)] +
           quadrics_[static_cast<size_t>(b)];
  }

  // The best point when the quadric has one near the edge, else its middle.
  Vector3d Place(int32_t a, int32_t b) const {
    const Vector3d middle = 0.5 * (mesh_.vertex(a) + mesh_.vertex(b));
    const double length = (mesh_.vertex(a) - mesh_.vertex(b)).norm();
    const Eigen::Matrix4d q = Quadric(a, b);
    Eigen::Matrix3d system = q.topLeftCorner<3, 3>();
    // A little weight on the middle keeps flat places evenly spread.
    const double pull = 1e-3 * (system.trace() + 1e-300);
    system += pull * Eigen::Matrix3d::Identity();
    const Vector3d place =
        system.partialPivLu().solve(pull * middle - q.topRightCorner<3, 1>());
    return (place - middle).norm() <= length ? place : middle;
  }

  double Cost(int32_t a, int32_t b, const Vector3d& place) const {
    const Vector4d p = place.homogeneous();
    const Eigen::Matrix4d q = Quadric(a, b);
    const double length2 = (mesh_.vertex(a) - mesh_.vertex(b)).squaredNorm();
    return p.dot(q * p) + 1e-4 * length2 * q.topLeftCorner<3, 3>().trace();
  }

  bool CanCollapse(int32_t a, int32_t b, const Vector3d& place) const {
    if (!IsInner(a) || !IsInner(b)) return false;
    const std::vector<int32_t> near_a = Neighbors(a);
    const std::vector<int32_t> near_b = Neighbors(b);
    std::vector<int32_t> shared;
    std::set_intersection(near_a.begin(), near_a.end(), near_b.begin(),
                          near_b.end(), std::back_inserter(shared));
    // Two shared neighbours and at least three others: no sheet folds up.
    if (shared.size() != 2 || near_a.size() + near_b.size() < 9) return false;
    for (const int32_t v : shared) {
      if (Neighbors(v).size() <= 3) return false;
    }
    return !Flips(a, b, place) && !Flips(b, a, place);
  }

  // Whether a face of v that does not hold `other` turns when v moves.
  bool Flips(int32_t v, int32_t other, const Vector3d& place) const {
    for (const int32_t f : FacesOf(v)) {
      std::array<Vector3d, 3> before;
      std::array<Vector3d, 3> after;
      bool holds_both = false;
      for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<size_t>(k);
        before[i] = mesh_.vertex(mesh_.F(f, k));
        after[i] = mesh_.F(f, k) == v ? place : before[i];
        holds_both = holds_both || mesh_.F(f, k) == other;
      }
      if (holds_both) continue;
      const Vector3d n = (before[1] - before[0]).cross(before[2] - before[0]);
      const Vector3d m = (after[1] - after[0]).cross(after[2] - after[0]);
      if (!(n.dot(m) > 0.2 * n.norm() * m.norm())) return true;
    }
    return false;
  }

  void Collapse(int32_t a, int32_t b, const Vector3d& place) {
    mesh_.V.row(a) = place.transpose();
    quadrics_[static_cast<size_t>(a)] = Quadric(a, b);
    std::vector<int32_t> kept;
    for (const int32_t f : FacesOf(a)) {
      (Holds(f, b) ? RemoveFace(f, a, b) : kept.push_back(f));
    }
    for (const int32_t f : FacesOf(b)) {
      if (!alive_[static_cast<size_t>(f)]) continue;
      for (int k = 0; k < 3; ++k) {
        if (mesh_.F(f, k) == b) mesh_.F(f, k) = a;
      }
      kept.push_back(f);
    }
    faces_of_[static_cast<size_t>(a)] = std::move(kept);
    faces_of_[static_cast<size_t>(b)].clear();
    // More than any edge of b can have had, so none of its edges is taken.
    ++age_[static_cast<size_t>(a)];
    age_[static_cast<size_t>(b)] = -(1 << 29);
    --num_vertices_;
    PushEdges(a, false);
  }

  bool Holds(int32_t f, int32_t v) const {
    return mesh_.F(f, 0) == v || mesh_.F(f, 1) == v || mesh_.F(f, 2) == v;
  }

  void RemoveFace(int32_t f, int32_t a, int32_t b) {
    alive_[static_cast<size_t>(f)] = false;
    for (int k = 0; k < 3; ++k) {
      const int32_t v = mesh_.F(f, k);
      if (v == a || v == b) continue;
      std::erase(faces_of_[static_cast<size_t>(v)], f);
    }
  }

  TriangleMesh mesh_;
  std::vector<Eigen::Matrix4d> quadrics_;
  std::vector<std::vector<int32_t>> faces_of_;
  std::vector<int32_t> age_;
  std::vector<bool> alive_;
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue_;
  int num_vertices_ = 0;
};

}  // namespace

TriangleMesh DecimateMesh(const TriangleMesh& mesh, int target_vertices) {
  return Decimator(mesh).Run(target_vertices);
}

}  // namespace argmesh
