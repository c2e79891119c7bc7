#include "core/containment/overlaid_faces.h"

#include <Eigen/LU>
#include <cmath>
#include <cstddef>

#include "core/containment/surface_samples.h"
#include "core/geometry/area.h"
#include "core/geometry/point_tree.h"

namespace argmesh {
namespace {

constexpr int kTargetSamples = 4 * kOverlaidSamples;
constexpr float kNear = 0.03F;  // of the query's size
constexpr float kMinCosine = 0.342F;
constexpr uint64_t kSeed = 1;

struct UnitSamples {
  SurfaceSamples samples;
  WindowFrame frame;
};

// In the frame of the mesh's own unit area.
UnitSamples SampleUnitArea(const TriangleMesh& mesh,
                           const Eigen::VectorXd& areas, int count) {
  UnitSamples unit;
  const TriangleMesh scaled = ToUnitArea(mesh, areas, unit.frame);
  unit.samples = SampleSurface(scaled, ComputeFaceAreas(scaled), count, kSeed);
  return unit;
}

}  // namespace

std::vector<std::array<int32_t, 2>> OverlayFaces(
    const TriangleMesh& query, const TriangleMesh& target,
    const Eigen::Matrix4d& transform) {
  std::vector<std::array<int32_t, 2>> pairs;
  const Eigen::VectorXd query_areas = ComputeFaceAreas(query);
  const Eigen::VectorXd target_areas = ComputeFaceAreas(target);
  if (!(query_areas.sum() > 0) || !(target_areas.sum() > 0)) return pairs;
  const UnitSamples laid = SampleUnitArea(query, query_areas, kOverlaidSamples);
  const UnitSamples base = SampleUnitArea(target, target_areas, kTargetSamples);
  const PointTree tree(base.samples.positions);

  const Eigen::Matrix3d turn = transform.topLeftCorner<3, 3>();
  const Eigen::Vector3d shift = transform.topRightCorner<3, 1>();
  const double scale = std::cbrt(std::abs(turn.determinant()));
  // The query's size in the target's unit frame.
  const double size = scale / laid.frame.scale * base.frame.scale;
  const float reach = kNear * static_cast<float>(size) +
                      1 / std::sqrt(static_cast<float>(kTargetSamples));
  pairs.reserve(laid.samples.positions.size());
  for (size_t i = 0; i < laid.samples.positions.size(); ++i) {
    const Eigen::Vector3d own =
        laid.frame.origin +
        laid.samples.positions[i].cast<double>() / laid.frame.scale;
    const Eigen::Vector3f place =
        (base.frame.scale * (turn * own + shift - base.frame.origin))
            .cast<float>();
    const Eigen::Vector3f normal =
        (turn * laid.samples.normals[i].cast<double>() / scale).cast<float>();
    int32_t face = -1;
    float nearest = 0;
    tree.VisitBall(place, reach, [&](int32_t at, float squared) {
      const auto number =
          static_cast<size_t>(tree.numbers()[static_cast<size_t>(at)]);
      if (face >= 0 && squared >= nearest) return;
      const float cosine = normal.dot(base.samples.normals[number]);
      if (std::abs(cosine) < kMinCosine) return;
      face = base.samples.faces[number];
      nearest = squared;
    });
    pairs.push_back({laid.samples.faces[i], face});
  }
  return pairs;
}

}  // namespace argmesh
