#include <cmath>
#include <cstdint>
#include <span>
#include <string>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "core/abstraction/decomposition.h"
#include "core/base/status_macros.h"
#include "core/graph/shape_graph.h"

namespace argmesh {
namespace {

// Far above any attribute of a real shape, far below what overflows when
// distances of attributes are summed.
constexpr float kMaxMagnitude = 1e6F;
// Histogram bins are rounded shares.
constexpr float kMaxShare = 1.001F;

// NaN is in no range.
bool InRange(float value, float low, float high) {
  return value >= low && value <= high;
}

bool AllInRange(std::span<const float> values, float low, float high) {
  for (const float value : values) {
    if (!InRange(value, low, high)) return false;
  }
  return true;
}

template <typename... Args>
absl::Status Malformed(const absl::FormatSpec<Args...>& format,
                       const Args&... args) {
  return absl::InvalidArgumentError("shape graph: " +
                                    absl::StrFormat(format, args...));
}

bool TupleInRange(const NodeTuple& tuple) {
  const float values[] = {tuple.normal_deviation, tuple.gauss_deviation,
                          tuple.gauss_mean,       tuple.mean_deviation,
                          tuple.mean_mean,        tuple.geodesic_deviation,
                          tuple.geodesic_mean,    tuple.log2_relative_area};
  return AllInRange(values, -kMaxMagnitude, kMaxMagnitude);
}

bool HistogramsInRange(const NodeHistograms& h) {
  return AllInRange(h.shape_diameter, 0, kMaxShare) &&
         AllInRange(h.average_geodesic, 0, kMaxShare) &&
         AllInRange(h.shape_index, 0, kMaxShare) &&
         AllInRange(h.curvedness, 0, kMaxShare) &&
         AllInRange(h.internal_distance, 0, kMaxShare) &&
         AllInRange(h.outer_distance, 0, kMaxShare) &&
         AllInRange(h.relative_diameter, 0, kMaxShare);
}

absl::Status CheckNode(const std::string& where, const ArgNode& node) {
  if (!(node.area > 0 && node.area <= 1)) {
    return Malformed("%s: area %g outside (0, 1]", where, node.area);
  }
  if (!TupleInRange(node.tuple)) {
    return Malformed("%s: tuple value not finite or beyond 1e6", where);
  }
  if (!HistogramsInRange(node.histograms)) {
    return Malformed("%s: histogram share outside 0 .. 1", where);
  }
  if (!AllInRange(node.wave_kernel, -kMaxMagnitude, kMaxMagnitude) ||
      !AllInRange(node.center, -kMaxMagnitude, kMaxMagnitude)) {
    return Malformed("%s: wave kernel or center not finite or beyond 1e6",
                     where);
  }
  return absl::OkStatus();
}

absl::Status CheckEdges(const std::string& where, const ArgLevel& level) {
  const ArgEdge* before = nullptr;
  for (const ArgEdge& edge : level.edges) {
    if (edge.a < 0 || edge.a >= edge.b || edge.b >= level.num_nodes()) {
      return Malformed("%s: edge %d-%d of %d nodes", where, edge.a, edge.b,
                       level.num_nodes());
    }
    if (before != nullptr &&
        (before->a > edge.a || (before->a == edge.a && before->b >= edge.b))) {
      return Malformed("%s: edge %d-%d out of order", where, edge.a, edge.b);
    }
    if (!InRange(edge.geodesic, 0, kMaxMagnitude) ||
        !InRange(edge.border_length, 0, kMaxMagnitude)) {
      return Malformed("%s: edge %d-%d: length outside 0 .. 1e6", where, edge.a,
                       edge.b);
    }
    before = &edge;
  }
  return absl::OkStatus();
}

// `num_parents` is the number of nodes of the parents' level, 0 when there is
// none.
absl::Status CheckLevel(const std::string& where, const ArgLevel& level,
                        int num_parents) {
  if (level.num_nodes() > kMaxGraphNodes) {
    return Malformed("%s: %d nodes, at most %d", where, level.num_nodes(),
                     kMaxGraphNodes);
  }
  if (!std::isfinite(level.threshold) || level.count < 0) {
    return Malformed("%s: threshold %g, count %d", where, level.threshold,
                     level.count);
  }
  for (int i = 0; i < level.num_nodes(); ++i) {
    const ArgNode& node = level.nodes[static_cast<size_t>(i)];
    ARGMESH_RETURN_IF_ERROR(
        CheckNode(absl::StrFormat("%s node %d", where, i), node));
    const bool fits = num_parents == 0
                          ? node.parent == -1
                          : node.parent >= 0 && node.parent < num_parents;
    if (!fits) {
      return Malformed("%s node %d: parent %d of %d", where, i, node.parent,
                       num_parents);
    }
  }
  const size_t k = level.nodes.size();
  const size_t pairs = k == 0 ? 0 : k * (k - 1) / 2;
  if (level.distances.size() != pairs) {
    return Malformed("%s: %d distances for %d pairs of nodes", where,
                     level.distances.size(), pairs);
  }
  if (!AllInRange(level.distances, 0, kMaxMagnitude)) {
    return Malformed("%s: distance outside 0 .. 1e6", where);
  }
  return CheckEdges(where, level);
}

absl::Status CheckModes(const ShapeGraph& graph, int num_nodes) {
  for (size_t i = 0; i < graph.modes.size(); ++i) {
    const ArgMode& mode = graph.modes[i];
    if (mode.node < 0 || mode.node >= num_nodes) {
      return Malformed("mode %d: node %d of %d", i, mode.node, num_nodes);
    }
    if (!AllInRange(mode.position, -kMaxMagnitude, kMaxMagnitude) ||
        !InRange(mode.window, 0, kMaxMagnitude) ||
        !InRange(mode.density, 0, kMaxMagnitude) ||
        !InRange(mode.offset, 0, kMaxMagnitude) || mode.repeatability < 0) {
      return Malformed("mode %d: value out of range", i);
    }
  }
  return absl::OkStatus();
}

}  // namespace

absl::Status CheckShapeGraph(const ShapeGraph& graph) {
  if (graph.levels.size() > static_cast<size_t>(kMaxGraphLevels)) {
    return Malformed("%d levels, at most %d", graph.levels.size(),
                     kMaxGraphLevels);
  }
  int num_parents = 0;
  for (size_t l = 0; l < graph.levels.size(); ++l) {
    const ArgLevel& level = graph.levels[l];
    if (level.nodes.empty()) return Malformed("level %d has no node", l);
    ARGMESH_RETURN_IF_ERROR(
        CheckLevel(absl::StrFormat("level %d", l), level, num_parents));
    num_parents = level.num_nodes();
  }
  ARGMESH_RETURN_IF_ERROR(CheckLevel("uniform", graph.uniform, num_parents));
  ARGMESH_RETURN_IF_ERROR(CheckModes(graph, num_parents));
  if (!(std::isfinite(graph.scale) && graph.scale > 0)) {
    return Malformed("scale %g", graph.scale);
  }
  for (const double x : graph.centroid) {
    if (!std::isfinite(x)) return Malformed("centroid not finite");
  }
  if (graph.num_components < 0 ||
      graph.decomposition > static_cast<uint32_t>(DecompositionKind::kGiven)) {
    return Malformed("%d components, decomposition %d", graph.num_components,
                     graph.decomposition);
  }
  return absl::OkStatus();
}

}  // namespace argmesh
