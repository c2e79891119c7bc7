#include "core/matching/packed_graph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "core/matching/attribute_groups.h"

namespace argmesh {
namespace {

using GroupFactors = std::array<float, kNumAttributeGroups>;

// Weight and scale of a group as one factor: weight / sum of weights / dims /
// scale.
GroupFactors Factors(float GroupShape::*weight,
                     const std::array<float, kNumAttributeGroups>& scale) {
  float sum = 0;
  for (const GroupShape& group : kGroups) sum += group.*weight;
  GroupFactors factors{};
  for (size_t g = 0; g < kNumAttributeGroups; ++g) {
    factors[g] = kGroups[g].*weight / sum /
                 static_cast<float>(kGroups[g].dims) / scale[g];
  }
  return factors;
}

// Appends the groups of factor > 0, then zeros up to `width`.
void AppendRow(const AttributeVector& x, const GroupFactors& factors,
               const std::array<float, kAttributeDims>& deviation, size_t width,
               std::vector<float>& rows) {
  const size_t end = rows.size() + width;
  for (size_t g = 0; g < kNumAttributeGroups; ++g) {
    if (factors[g] == 0) continue;
    for (size_t k = 0; k < kGroups[g].dims; ++k) {
      const size_t d = GroupOffset(g) + k;
      rows.push_back(x[d] / deviation[d] * factors[g]);
    }
  }
  rows.resize(end, 0.0F);
}

constexpr size_t WidthOf(float GroupShape::*weight) {
  size_t width = 0;
  for (const GroupShape& group : kGroups) {
    if (group.*weight > 0) width += group.dims;
  }
  return width;
}

static_assert(WidthOf(&GroupShape::full_weight) <= kFullWidth);
static_assert(WidthOf(&GroupShape::tuple_weight) <= kTupleWidth);
static_assert(WidthOf(&GroupShape::partial_weight) <= kPartialWidth);

PackedLevel Pack(const ArgLevel& level, const FrozenScales& scales,
                 const std::array<float, kNumAttributeGroups>& group_scale) {
  const GroupFactors full = Factors(&GroupShape::full_weight, group_scale);
  const GroupFactors tuple = Factors(&GroupShape::tuple_weight, group_scale);
  const GroupFactors partial =
      Factors(&GroupShape::partial_weight, scales.partial);
  PackedLevel packed;
  float sum = 0;
  for (const ArgNode& node : level.nodes) {
    const AttributeVector x = ExtractAttributes(node);
    AppendRow(x, full, scales.deviation, kFullWidth, packed.full);
    AppendRow(x, tuple, scales.deviation, kTupleWidth, packed.tuple);
    AppendRow(x, partial, scales.deviation, kPartialWidth, packed.partial);
    packed.area.push_back(node.area);
    packed.weight.push_back(std::sqrt(node.area));
    sum += packed.weight.back();
  }
  for (float& weight : packed.weight) weight /= sum;
  for (int i = 0; i < level.num_nodes(); ++i) {
    for (int j = 0; j < level.num_nodes(); ++j) {
      packed.distances.push_back(level.Distance(i, j));
    }
  }
  return packed;
}

int CompareFloats(const std::vector<float>& a, const std::vector<float>& b) {
  const size_t n = std::min(a.size(), b.size());
  for (size_t i = 0; i < n; ++i) {
    if (a[i] < b[i]) return -1;
    if (b[i] < a[i]) return 1;
  }
  return 0;
}

}  // namespace

const std::vector<float>& PackedLevel::rows(RowKind kind) const {
  switch (kind) {
    case RowKind::kFull:
      return full;
    case RowKind::kTuple:
      return tuple;
    case RowKind::kPartial:
      return partial;
  }
  return full;
}

int CompareLevels(const PackedLevel& a, const PackedLevel& b, RowKind kind) {
  if (a.num_nodes() != b.num_nodes()) return a.num_nodes() - b.num_nodes();
  if (const int order = CompareFloats(a.rows(kind), b.rows(kind)); order != 0) {
    return order;
  }
  if (const int order = CompareFloats(a.area, b.area); order != 0) return order;
  return CompareFloats(a.distances, b.distances);
}

MatchableGraph::MatchableGraph(const ShapeGraph& graph,
                               const FrozenScales& scales)
    : impl_(std::make_unique<Impl>()) {
  for (const ArgLevel& level : graph.levels) {
    impl_->levels.push_back(Pack(level, scales, scales.component));
  }
  impl_->uniform = Pack(graph.uniform, scales, scales.uniform);
  impl_->names = LevelNames(graph);
}

MatchableGraph::~MatchableGraph() = default;
MatchableGraph::MatchableGraph(MatchableGraph&&) noexcept = default;
MatchableGraph& MatchableGraph::operator=(MatchableGraph&&) noexcept = default;

}  // namespace argmesh
