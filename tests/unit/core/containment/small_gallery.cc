#include "tests/unit/core/containment/small_gallery.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/random.h"
#include "core/containment/target_windows.h"
#include "core/containment/window_words.h"
#include "core/synthesis/mesh_cut.h"
#include "core/synthesis/sample_shape.h"

namespace argmesh {
namespace {

SmallGallery MakeGallery() {
  SmallGallery gallery;
  for (const char* name : {"airplane", "bird", "chair", "fish", "human", "mug",
                           "octopus", "quadruped", "teapot", "vase"}) {
    SampleShapeOptions options;
    options.target_vertices = 2500;
    const absl::StatusOr<SampleShape> shape = MakeSampleShape(name, 3, options);
    if (!shape.ok()) std::abort();
    absl::StatusOr<TargetWindows> windows = ExtractTargetWindows(shape->mesh);
    if (!windows.ok()) std::abort();
    gallery.index.Set(static_cast<int64_t>(gallery.meshes.size()),
                      AssignWindowWords(*windows));
    gallery.classes.push_back(name);
    gallery.meshes.push_back(shape->mesh);
    gallery.windows.push_back(
        std::make_shared<const TargetWindows>(*std::move(windows)));
  }
  return gallery;
}

}  // namespace

LoadWindows SmallGallery::Loader() const {
  return [this](int64_t slot)
             -> absl::StatusOr<std::shared_ptr<const TargetWindows>> {
    return windows[static_cast<size_t>(slot)];
  };
}

int64_t SmallGallery::SlotOf(const std::string& class_name) const {
  return std::find(classes.begin(), classes.end(), class_name) -
         classes.begin();
}

const SmallGallery& Gallery() {
  static const SmallGallery* const kGallery = new SmallGallery(MakeGallery());
  return *kGallery;
}

MovedPiece CutAndMove(const TriangleMesh& mesh, int axis, uint64_t seed) {
  Random random(seed);
  MovedPiece piece;
  piece.mesh = CutHalf(mesh, axis);
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond(random.Normal(), random.Normal(), random.Normal(),
                         random.Normal())
          .normalized();
  const double scale = std::exp(random.Uniform(-2, 2));
  const Eigen::Vector3d shift(random.Normal(), random.Normal(),
                              random.Normal());
  Eigen::Matrix4d there = Eigen::Matrix4d::Identity();
  there.topLeftCorner<3, 3>() = scale * turn.toRotationMatrix();
  there.topRightCorner<3, 1>() = shift;
  piece.mesh.V =
      (piece.mesh.V * there.topLeftCorner<3, 3>().transpose()).rowwise() +
      shift.transpose();
  piece.transform = there.inverse();
  return piece;
}

TriangleMesh TurnedInsideOut(TriangleMesh mesh) {
  mesh.F.col(1).swap(mesh.F.col(2));
  return mesh;
}

}  // namespace argmesh
