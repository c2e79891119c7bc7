#include "core/geometry/shape_diameter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "core/geometry/area.h"
#include "core/geometry/ray_scene.h"

namespace argmesh {
namespace {

// In units of sqrt(area).
constexpr float kOriginOffset = 1e-4F;
constexpr float kNearestHit = 2e-4F;
constexpr double kDiameterOfNothing = 0.1;

constexpr int kMinHits = 3;
constexpr int kMaxFillRounds = 64;
constexpr double kGoldenAngle = 2.399963229;

// Directions in a cone around +z, evenly spread, on a golden spiral.
std::vector<Eigen::Vector3f> ConeDirections(const ShapeDiameterOptions& o) {
  std::vector<Eigen::Vector3f> directions;
  const double cap = 1 - std::cos(o.cone_half_angle * std::numbers::pi / 180);
  for (int i = 0; i < o.num_rays; ++i) {
    const double z = 1 - cap * (i + 0.5) / o.num_rays;
    const double r = std::sqrt(1 - z * z);
    const double azimuth = i * kGoldenAngle;
    directions.push_back(
        Eigen::Vector3d(r * std::cos(azimuth), r * std::sin(azimuth), z)
            .cast<float>());
  }
  return directions;
}

struct Hit {
  float distance;
  float weight;
};

// Cosine-weighted mean of the hits within one standard deviation of the
// median.
double RobustMean(std::vector<Hit>& hits) {
  std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) {
    return a.distance != b.distance ? a.distance < b.distance
                                    : a.weight < b.weight;
  });
  const double median = hits[hits.size() / 2].distance;
  const auto count = static_cast<double>(hits.size());
  double mean = 0;
  for (const Hit& hit : hits) mean += hit.distance;
  mean /= count;
  double variance = 0;
  for (const Hit& hit : hits) {
    variance += (hit.distance - mean) * (hit.distance - mean);
  }
  const double deviation = std::sqrt(variance / count);
  double sum = 0;
  double weight = 0;
  for (const Hit& hit : hits) {
    if (std::abs(hit.distance - median) > deviation + 1e-9) continue;
    sum += static_cast<double>(hit.distance) * hit.weight;
    weight += hit.weight;
  }
  return weight > 0 ? sum / weight : median;
}

// A frame around `inward` whose first axis points along the longest edge at
// `v`: it turns with the surface, so the rays do as well.
Eigen::Matrix3f RayFrame(const TriangleMesh& mesh, const SurfaceGraph& graph,
                         int v, const Eigen::Vector3d& inward) {
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
  float longest = 0;
  for (int32_t e = graph.offsets.data()[v]; e < graph.offsets.data()[v + 1];
       ++e) {
    if (graph.kinds.data()[e] != LinkKind::kEdge) continue;
    if (graph.lengths.data()[e] <= longest) continue;
    longest = graph.lengths.data()[e];
    along = mesh.vertex(graph.targets.data()[e]) - mesh.vertex(v);
  }
  Eigen::Vector3d tangent = along - along.dot(inward) * inward;
  if (tangent.norm() > 1e-3 * along.norm()) {
    tangent.normalize();
  } else {
    tangent = inward.unitOrthogonal();
  }
  Eigen::Matrix3d frame;
  frame << tangent, inward.cross(tangent), inward;
  return frame.cast<float>();
}

// Diameters of the vertices in units of sqrt(area); < 0 where too few rays
// hit anything.
std::vector<double> Measure(const TriangleMesh& unit_mesh,
                            const VertexMatrix& normals,
                            const SurfaceGraph& graph, const RayScene& scene,
                            const std::vector<Eigen::Vector3f>& directions) {
  std::vector<double> diameters;
  std::vector<Hit> hits;
  for (int v = 0; v < unit_mesh.num_vertices(); ++v) {
    const Eigen::Vector3d inward = -normals.row(v).transpose();
    hits.clear();
    if (inward.squaredNorm() > 0.5) {
      const Eigen::Matrix3f frame = RayFrame(unit_mesh, graph, v, inward);
      const Eigen::Vector3f origin =
          unit_mesh.vertex(v).cast<float>() + kOriginOffset * frame.col(2);
      for (const Eigen::Vector3f& direction : directions) {
        const auto t = scene.FindExit(origin, frame * direction, kNearestHit);
        if (t) hits.push_back({*t, direction.z()});
      }
    }
    diameters.push_back(hits.size() >= kMinHits ? RobustMean(hits) : -1);
  }
  return diameters;
}

// The mean of the neighbours that have a value; nothing without such.
std::optional<double> NeighborMean(const SurfaceGraph& graph, int32_t v,
                                   const std::vector<double>& values) {
  double sum = 0;
  int count = 0;
  for (int32_t e = graph.offsets.data()[v]; e < graph.offsets.data()[v + 1];
       ++e) {
    const double value = values.data()[graph.targets.data()[e]];
    if (graph.kinds.data()[e] != LinkKind::kEdge || value <= 0) continue;
    sum += value;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

// Gives vertices without a value the mean of their neighbours', round by
// round, and those out of reach the mean of all.
void FillGaps(const SurfaceGraph& graph, std::vector<double>& values) {
  double sum = 0;
  int count = 0;
  std::vector<int32_t> open;
  for (size_t v = 0; v < values.size(); ++v) {
    if (values[v] > 0) {
      sum += values[v];
      ++count;
    } else {
      open.push_back(static_cast<int32_t>(v));
    }
  }
  const double mean = count > 0 ? sum / count : kDiameterOfNothing;
  for (int round = 0; round < kMaxFillRounds && !open.empty(); ++round) {
    const std::vector<double> before = values;
    std::vector<int32_t> still_open;
    for (const int32_t v : open) {
      if (const auto near = NeighborMean(graph, v, before)) {
        values.data()[v] = *near;
      } else {
        still_open.push_back(v);
      }
    }
    if (still_open.size() == open.size()) break;
    open.swap(still_open);
  }
  for (const int32_t v : open) values.data()[v] = mean;
}

void Smooth(const SurfaceGraph& graph, int steps, std::vector<double>& values) {
  for (int step = 0; step < steps; ++step) {
    const std::vector<double> before = values;
    for (int32_t v = 0; v < graph.num_vertices(); ++v) {
      double sum = 2 * before.data()[v];
      double weight = 2;
      for (int32_t e = graph.offsets.data()[v]; e < graph.offsets.data()[v + 1];
           ++e) {
        if (graph.kinds.data()[e] != LinkKind::kEdge) continue;
        sum += before.data()[graph.targets.data()[e]];
        weight += 1;
      }
      values.data()[v] = sum / weight;
    }
  }
}

absl::Status CheckOptions(const ShapeDiameterOptions& o) {
  if (o.num_rays < 3 || o.num_rays > 1000) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "shape diameter: %d rays, must be 3 .. 1000", o.num_rays));
  }
  if (!(o.cone_half_angle >= 1 && o.cone_half_angle <= 89)) {
    return absl::InvalidArgumentError(
        absl::StrFormat("shape diameter: cone half angle of %g degrees, must "
                        "be 1 .. 89",
                        o.cone_half_angle));
  }
  if (o.smoothing_steps < 0) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "shape diameter: %d smoothing steps, must be >= 0", o.smoothing_steps));
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<Eigen::VectorXd> ComputeShapeDiameter(
    const TriangleMesh& mesh, const VertexMatrix& normals,
    const SurfaceGraph& graph, const ShapeDiameterOptions& options) {
  if (absl::Status status = CheckOptions(options); !status.ok()) return status;
  const double size = std::sqrt(ComputeFaceAreas(mesh).sum());
  if (!(size > 0)) {
    return absl::FailedPreconditionError(
        "shape diameter: no face of positive area");
  }
  // The ray tracer works with floats: bring the mesh to the origin and to
  // area 1.
  TriangleMesh unit_mesh = mesh;
  const Eigen::RowVector3d centre =
      (mesh.V.colwise().minCoeff() + mesh.V.colwise().maxCoeff()) / 2;
  unit_mesh.V = (mesh.V.rowwise() - centre) / size;
  auto scene = RayScene::Create(unit_mesh);
  if (!scene.ok()) return scene.status();
  std::vector<double> values =
      Measure(unit_mesh, normals, graph, *scene, ConeDirections(options));
  FillGaps(graph, values);
  Smooth(graph, options.smoothing_steps, values);
  return Eigen::Map<const Eigen::VectorXd>(
             values.data(), static_cast<Eigen::Index>(values.size())) *
         size;
}

}  // namespace argmesh
