#include "core/signature/point_fields.h"

#include <array>
#include <span>
#include <vector>

#include "core/base/status_macros.h"
#include "core/geometry/point_tree.h"
#include "core/geometry/ray_scene.h"
#include "core/signature/ball_fields.h"
#include "core/signature/codebook.h"
#include "core/signature/point_geodesics.h"
#include "core/signature/ray_fields.h"
#include "core/signature/surface_points.h"

namespace argmesh {
namespace {

constexpr int kPointsBetweenChecks = 64;

absl::Status MeasureBalls(const SurfacePoints& points, const StopToken& stop,
                          PointRows& fields) {
  const BallMeter meter(points.positions, points.normals);
  for (int i = 0; i < kDescribedPoints; ++i) {
    if (i % kPointsBetweenChecks == 0) {
      ARGMESH_RETURN_IF_ERROR(stop.Check());
    }
    const TwoBalls balls = meter.Measure(i);
    int column = kShapeIndexNear;
    for (const BallFields& ball : {balls.near, balls.wide}) {
      fields(i, column++) = ball.shape_index;
      fields(i, column++) = ball.curvedness;
      fields(i, column++) = ball.area;
      fields(i, column++) = ball.offset;
    }
  }
  return absl::OkStatus();
}

absl::Status CastRays(const SignatureSurface& surface,
                      const SurfacePoints& points, const StopToken& stop,
                      PointRows& fields) {
  ARGMESH_ASSIGN_OR_RETURN(const RayScene scene,
                           RayScene::Create(surface.mesh));
  for (int i = 0; i < kDescribedPoints; ++i) {
    if (i % kPointsBetweenChecks == 0) {
      ARGMESH_RETURN_IF_ERROR(stop.Check());
    }
    const auto place = static_cast<size_t>(i);
    const RayFields rays =
        CastPointRays(scene, points.positions[place], points.normals[place]);
    fields(i, kThickness) = rays.thickness;
    fields(i, kOcclusion) = rays.occlusion;
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<PointRows> MeasurePointFields(const SignatureSurface& surface,
                                             const StopToken& stop) {
  const SurfacePoints points = SpreadPoints(surface);
  PointRows fields(kDescribedPoints, kNumFields);
  ARGMESH_RETURN_IF_ERROR(MeasureBalls(points, stop, fields));
  ARGMESH_RETURN_IF_ERROR(CastRays(surface, points, stop, fields));
  ARGMESH_ASSIGN_OR_RETURN(
      const std::vector<float> geodesics,
      MeanPointGeodesics(points.positions, points.normals, stop));
  for (int i = 0; i < kDescribedPoints; ++i) {
    const auto place = static_cast<size_t>(i);
    fields(i, kCentrality) = points.positions[place].norm();
    fields(i, kGeodesic) = geodesics[place];
  }
  return fields;
}

}  // namespace argmesh
