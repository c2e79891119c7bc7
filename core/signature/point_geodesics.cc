#include "core/signature/point_geodesics.h"

#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/base/status_macros.h"
#include "core/geometry/point_tree.h"
#include "core/geometry/vertex_queue.h"
#include "core/mesh/mesh_edges.h"

namespace argmesh {
namespace {

constexpr int kNodes = 2048;
constexpr int kSources = 32;
constexpr float kLinkLength = 0.06F;
constexpr float kOpposition = -0.3F;  // least cosine between linked normals
constexpr float kUnreached = std::numeric_limits<float>::infinity();

// Links of node i are those at offsets[i] .. offsets[i+1].
struct PointLinks {
  std::vector<int32_t> offsets;
  std::vector<int32_t> targets;
  std::vector<float> lengths;
};

PointLinks LinkPoints(std::span<const Eigen::Vector3f> positions,
                      std::span<const Eigen::Vector3f> normals) {
  const PointTree tree(positions);
  PointLinks links;
  links.offsets.push_back(0);
  for (int32_t i = 0; i < kNodes; ++i) {
    const Eigen::Vector3f& normal = normals[Slot(i)];
    tree.VisitBall(positions[Slot(i)], kLinkLength,
                   [&](int32_t place, float squared) {
                     const int32_t j = tree.numbers()[Slot(place)];
                     if (j == i || normal.dot(normals[Slot(j)]) < kOpposition)
                       return;
                     links.targets.push_back(j);
                     links.lengths.push_back(std::sqrt(squared));
                   });
    links.offsets.push_back(static_cast<int32_t>(links.targets.size()));
  }
  return links;
}

void FindDistances(const PointLinks& links, int32_t source, VertexQueue& queue,
                   std::vector<float>& distances) {
  distances.assign(kNodes, kUnreached);
  distances[Slot(source)] = 0;
  queue.Clear();
  queue.Push(0, source);
  while (!queue.empty()) {
    const auto [distance, node] = queue.Pop();
    if (distance > distances[Slot(node)]) continue;
    for (int32_t e = links.offsets[Slot(node)];
         e < links.offsets[Slot(node) + 1]; ++e) {
      const int32_t target = links.targets[Slot(e)];
      const float through = distance + links.lengths[Slot(e)];
      if (through >= distances[Slot(target)]) continue;
      distances[Slot(target)] = through;
      queue.Push(through, target);
    }
  }
}

}  // namespace

absl::StatusOr<std::vector<float>> MeanPointGeodesics(
    std::span<const Eigen::Vector3f> positions,
    std::span<const Eigen::Vector3f> normals, const StopToken& stop) {
  positions = positions.first(kNodes);
  const PointLinks links = LinkPoints(positions, normals);
  std::vector<float> means(kNodes, 0);
  std::vector<float> distances;
  VertexQueue queue;
  for (int32_t source = 0; source < kSources; ++source) {
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    FindDistances(links, source, queue, distances);
    for (int32_t i = 0; i < kNodes; ++i) {
      means[Slot(i)] +=
          distances[Slot(i)] < kUnreached
              ? distances[Slot(i)]
              : (positions[Slot(i)] - positions[Slot(source)]).norm();
    }
  }
  for (float& mean : means) mean /= kSources;
  return means;
}

}  // namespace argmesh
