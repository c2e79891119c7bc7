#include "core/graph/shape_graph.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_format.h"

namespace argmesh {

float ArgLevel::Distance(int i, int j) const {
  if (i == j) return 0;
  if (i > j) std::swap(i, j);
  // Rows 0 .. i-1 hold (k-1) + (k-2) + .. + (k-i) values.
  const auto before =
      static_cast<size_t>(i) * static_cast<size_t>(2 * num_nodes() - i - 1) / 2;
  return distances[before + static_cast<size_t>(j - i - 1)];
}

std::vector<std::string> LevelNames(const ShapeGraph& graph) {
  std::vector<std::string> names;
  for (const ArgLevel& level : graph.levels) {
    names.push_back(level.count > 0
                        ? absl::StrFormat("count-%d", level.count)
                        : absl::StrFormat("ncut-%g", level.threshold));
  }
  names.emplace_back("uniform");
  return names;
}

std::vector<int16_t> LabelsAtLevel(const ShapeGraph& graph,
                                   const FaceLabels& labels, int level) {
  std::vector<int16_t> at_level = labels.component;
  for (size_t l = graph.levels.size(); l-- > static_cast<size_t>(level) + 1;) {
    const std::vector<ArgNode>& nodes = graph.levels[l].nodes;
    for (int16_t& label : at_level) {
      const bool known =
          label >= 0 && static_cast<size_t>(label) < nodes.size();
      label =
          known ? static_cast<int16_t>(nodes[static_cast<size_t>(label)].parent)
                : int16_t{-1};
    }
  }
  return at_level;
}

}  // namespace argmesh
