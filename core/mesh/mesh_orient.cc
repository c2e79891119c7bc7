#include "core/mesh/mesh_orient.h"

#include <Eigen/Geometry>

#include "core/mesh/mesh_weld.h"

namespace argmesh {
namespace {

// Turning (a, b, c) into (a, c, b) puts side c at 2 - c.
int32_t SideAfterFlip(int32_t side) { return side - side % 3 + 2 - side % 3; }

int32_t StartOfSide(const FaceMatrix& F, int32_t side) {
  return F(side / 3, side % 3);
}

// Sets component and flipped of every face reached from `seed`; false when the
// component is unorientable.
bool FloodComponent(const FaceMatrix& F, int32_t seed,
                    OrientedFaces& oriented) {
  bool orientable = true;
  std::vector<int32_t> queue = {seed};
  oriented.component[Slot(seed)] = oriented.num_components;
  for (size_t head = 0; head < queue.size(); ++head) {
    const int32_t f = queue[head];
    for (int32_t side = 3 * f; side < 3 * f + 3; ++side) {
      const int32_t twin = oriented.twins[Slot(side)];
      if (twin < 0) continue;
      const int32_t g = twin / 3;
      const bool same_way = StartOfSide(F, side) == StartOfSide(F, twin);
      const char wanted = (oriented.flipped[Slot(f)] != 0) != same_way ? 1 : 0;
      if (oriented.component[Slot(g)] < 0) {
        oriented.component[Slot(g)] = oriented.num_components;
        oriented.flipped[Slot(g)] = wanted;
        queue.push_back(g);
      } else if (oriented.flipped[Slot(g)] != wanted) {
        orientable = false;
      }
    }
  }
  return orientable;
}

void FlipComponents(const std::vector<char>& flip_component,
                    OrientedFaces& oriented) {
  for (size_t f = 0; f < oriented.flipped.size(); ++f) {
    if (flip_component[Slot(oriented.component[f])]) oriented.flipped[f] ^= 1;
  }
}

// Turns components over whose flipped area is more than half of their area.
void KeepMostOfTheArea(const TriangleMesh& mesh, OrientedFaces& oriented) {
  std::vector<double> surplus(Slot(oriented.num_components), 0);
  for (int f = 0; f < mesh.num_faces(); ++f) {
    const double area = FaceCross(mesh, f).norm();
    surplus[Slot(oriented.component[Slot(f)])] +=
        oriented.flipped[Slot(f)] ? area : -area;
  }
  std::vector<char> flip(surplus.size());
  for (size_t i = 0; i < flip.size(); ++i) flip[i] = surplus[i] > 0 ? 1 : 0;
  FlipComponents(flip, oriented);
}

// Flips the rows of the faces in `flip` and renumbers the sides in `twins`.
void ApplyFlips(const std::vector<char>& flip, TriangleMesh& mesh,
                std::vector<int32_t>& twins) {
  const auto side_after = [&flip](int32_t side) {
    return flip[Slot(side / 3)] ? SideAfterFlip(side) : side;
  };
  for (int f = 0; f < mesh.num_faces(); ++f) {
    if (!flip[Slot(f)]) continue;
    std::swap(mesh.F(f, 1), mesh.F(f, 2));
    std::swap(twins[3 * Slot(f)], twins[3 * Slot(f) + 2]);
  }
  for (int32_t& twin : twins) {
    if (twin >= 0) twin = side_after(twin);
  }
}

void CutSeams(const FaceMatrix& F, std::vector<int32_t>& twins) {
  for (int32_t side = 0; Slot(side) < twins.size(); ++side) {
    const int32_t twin = twins[Slot(side)];
    if (twin >= 0 && StartOfSide(F, side) == StartOfSide(F, twin)) {
      twins[Slot(side)] = twins[Slot(twin)] = -1;
    }
  }
}

}  // namespace

OrientedFaces OrientFaces(TriangleMesh& mesh, const MeshEdges& edges) {
  OrientedFaces oriented;
  oriented.twins = ComputeTwins(edges, mesh.num_faces());
  oriented.component.assign(Slot(mesh.num_faces()), -1);
  oriented.flipped.assign(Slot(mesh.num_faces()), 0);
  for (int32_t f = 0; f < mesh.num_faces(); ++f) {
    if (oriented.component[Slot(f)] >= 0) continue;
    if (!FloodComponent(mesh.F, f, oriented)) {
      ++oriented.unorientable_components;
    }
    ++oriented.num_components;
  }
  KeepMostOfTheArea(mesh, oriented);
  ApplyFlips(oriented.flipped, mesh, oriented.twins);
  CutSeams(mesh.F, oriented.twins);
  return oriented;
}

void OrientOutwards(TriangleMesh& mesh, OrientedFaces& oriented) {
  const size_t count = Slot(oriented.num_components);
  std::vector<char> open(count, 0);
  std::vector<double> volume(count, 0);
  std::vector<int32_t> origin(count, -1);
  for (int32_t f = 0; f < mesh.num_faces(); ++f) {
    const size_t i = Slot(oriented.component[Slot(f)]);
    if (origin[i] < 0) origin[i] = mesh.F(f, 0);
    const Eigen::Vector3d o = mesh.vertex(origin[i]);
    volume[i] += (mesh.vertex(mesh.F(f, 0)) - o).dot(FaceCross(mesh, f));
    for (size_t side = 3 * Slot(f); side < 3 * Slot(f) + 3; ++side) {
      if (oriented.twins[side] < 0) open[i] = 1;
    }
  }
  std::vector<char> flip_component(count);
  for (size_t i = 0; i < count; ++i) {
    flip_component[i] = !open[i] && volume[i] < 0 ? 1 : 0;
  }
  FlipComponents(flip_component, oriented);
  std::vector<char> flip(oriented.component.size());
  for (size_t f = 0; f < flip.size(); ++f) {
    flip[f] = flip_component[Slot(oriented.component[f])];
  }
  ApplyFlips(flip, mesh, oriented.twins);
}

}  // namespace argmesh
