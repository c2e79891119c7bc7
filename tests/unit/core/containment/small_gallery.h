// A few sample shapes with their windows, made once for all tests.
#ifndef ARGMESH_TESTS_UNIT_CORE_CONTAINMENT_SMALL_GALLERY_H_
#define ARGMESH_TESTS_UNIT_CORE_CONTAINMENT_SMALL_GALLERY_H_

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "core/containment/containment_ranking.h"
#include "core/containment/window_index.h"
#include "core/containment/window_set.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct SmallGallery {
  std::vector<std::string> classes;  // by slot
  std::vector<TriangleMesh> meshes;
  std::vector<std::shared_ptr<const TargetWindows>> windows;
  WindowIndex index;

  LoadWindows Loader() const;
  int64_t SlotOf(const std::string& class_name) const;
};

const SmallGallery& Gallery();

// A piece of a mesh, moved: `transform` takes it back.
struct MovedPiece {
  TriangleMesh mesh;
  Eigen::Matrix4d transform;  // piece's own units to the mesh's
};

// What lies beyond the middle of the box on `axis`, under a seeded similarity.
MovedPiece CutAndMove(const TriangleMesh& mesh, int axis, uint64_t seed);

TriangleMesh TurnedInsideOut(TriangleMesh mesh);

}  // namespace argmesh

#endif  // ARGMESH_TESTS_UNIT_CORE_CONTAINMENT_SMALL_GALLERY_H_
