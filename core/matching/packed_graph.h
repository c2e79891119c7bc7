// A graph laid out for matching: one contiguous row of scaled attributes for
// each node, so that the distance of two nodes is a plain L1 distance.
#ifndef ARGMESH_CORE_MATCHING_PACKED_GRAPH_H_
#define ARGMESH_CORE_MATCHING_PACKED_GRAPH_H_

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/graph/shape_graph.h"
#include "core/matching/frozen_scales.h"
#include "core/matching/match.h"

namespace argmesh {

// Row widths, multiples of 4 so that SSE needs no remainder.
inline constexpr size_t kFullWidth = 84;
inline constexpr size_t kTupleWidth = 8;
inline constexpr size_t kPartialWidth = 36;

enum class RowKind { kFull, kTuple, kPartial };

struct PackedLevel {
  std::vector<float> full;     // num_nodes x kFullWidth
  std::vector<float> tuple;    // num_nodes x kTupleWidth
  std::vector<float> partial;  // num_nodes x kPartialWidth
  std::vector<float> area;
  std::vector<float> weight;     // sqrt(area) / sum of sqrt(area)
  std::vector<float> distances;  // num_nodes x num_nodes

  int num_nodes() const { return static_cast<int>(area.size()); }
  const std::vector<float>& rows(RowKind kind) const;
  float Distance(size_t i, size_t j) const {
    return distances[i * area.size() + j];
  }
};

// A total order of contents, the smaller level first: every computation on a
// pair of levels is done in this order, which makes it symmetric to the bit.
// < 0, 0 (equal in all that scores look at) or > 0.
int CompareLevels(const PackedLevel& a, const PackedLevel& b, RowKind kind);

struct MatchableGraph::Impl {
  std::vector<PackedLevel> levels;  // components, coarse to fine
  PackedLevel uniform;              // no nodes when the graph has none
  std::vector<std::string> names;   // as LevelNames

  // `index` = levels.size() is the uniform level.
  const PackedLevel& Level(size_t index) const {
    return index < levels.size() ? levels[index] : uniform;
  }
};

}  // namespace argmesh

#endif  // ARGMESH_CORE_MATCHING_PACKED_GRAPH_H_
