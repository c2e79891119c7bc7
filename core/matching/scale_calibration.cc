#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "core/base/random.h"
#include "core/matching/frozen_scales.h"

namespace argmesh {
namespace {

constexpr uint64_t kPairSeed = 3;
constexpr int kPairs = 20000;
constexpr float kMinScale = 1e-4F;

using NodesOfGraph = std::vector<AttributeVector>;

void AddNodes(const ArgLevel& level, NodesOfGraph& nodes) {
  for (const ArgNode& node : level.nodes) {
    nodes.push_back(ExtractAttributes(node));
  }
}

std::array<float, kAttributeDims> Deviations(
    std::span<const NodesOfGraph> graphs) {
  std::array<double, kAttributeDims> sum{}, squares{};
  double count = 0;
  for (const NodesOfGraph& nodes : graphs) {
    for (const AttributeVector& x : nodes) {
      count += 1;
      for (size_t d = 0; d < kAttributeDims; ++d) {
        sum[d] += static_cast<double>(x[d]);
        squares[d] += static_cast<double>(x[d]) * static_cast<double>(x[d]);
      }
    }
  }
  std::array<float, kAttributeDims> deviation{};
  deviation.fill(1);
  for (size_t g = 0; g < kNumAttributeGroups; ++g) {
    if (kGroups[g].histogram) continue;
    for (size_t k = 0; k < kGroups[g].dims; ++k) {
      const size_t d = GroupOffset(g) + k;
      const double mean = sum[d] / count;
      const double variance = std::max(0.0, squares[d] / count - mean * mean);
      deviation[d] =
          std::max(kMinScale, static_cast<float>(std::sqrt(variance)));
    }
  }
  return deviation;
}

double GroupDistance(const AttributeVector& x, const AttributeVector& y,
                     const std::array<float, kAttributeDims>& deviation,
                     size_t group) {
  double sum = 0;
  for (size_t k = 0; k < kGroups[group].dims; ++k) {
    const size_t d = GroupOffset(group) + k;
    sum += static_cast<double>(std::abs(x[d] - y[d]) / deviation[d]);
  }
  return sum / static_cast<double>(kGroups[group].dims);
}

// Mean group distances of random nodes of two different graphs.
std::array<float, kNumAttributeGroups> MeanDistances(
    std::span<const NodesOfGraph> graphs,
    const std::array<float, kAttributeDims>& deviation) {
  std::vector<const NodesOfGraph*> filled;
  for (const NodesOfGraph& nodes : graphs) {
    if (!nodes.empty()) filled.push_back(&nodes);
  }
  std::array<float, kNumAttributeGroups> scale{};
  scale.fill(1);
  if (filled.size() < 2) return scale;
  Random random(kPairSeed);
  std::array<double, kNumAttributeGroups> sum{};
  for (int pair = 0; pair < kPairs; ++pair) {
    const uint64_t a = random.Below(filled.size());
    const uint64_t b =
        (a + 1 + random.Below(filled.size() - 1)) % filled.size();
    const AttributeVector& x = (*filled[a])[random.Below(filled[a]->size())];
    const AttributeVector& y = (*filled[b])[random.Below(filled[b]->size())];
    for (size_t g = 0; g < kNumAttributeGroups; ++g) {
      sum[g] += GroupDistance(x, y, deviation, g);
    }
  }
  for (size_t g = 0; g < kNumAttributeGroups; ++g) {
    scale[g] = std::max(kMinScale, static_cast<float>(sum[g] / kPairs));
  }
  return scale;
}

void AppendArray(std::span<const float> values, std::string& out) {
  out += "    {";
  for (size_t i = 0; i < values.size(); ++i) {
    const char* separator =
        i + 1 == values.size() ? "" : (i % 7 == 6 ? ",\n     " : ", ");
    out += absl::StrFormat("%.5fF%s", values[i], separator);
  }
  out += "},\n";
}

}  // namespace

absl::StatusOr<FrozenScales> ComputeFrozenScales(
    std::span<const ShapeGraph> graphs) {
  std::vector<NodesOfGraph> finest, uniform, both;
  for (const ShapeGraph& graph : graphs) {
    if (graph.levels.empty()) continue;
    AddNodes(graph.levels.back(), finest.emplace_back());
    AddNodes(graph.uniform, uniform.emplace_back());
    both.push_back(finest.back());
    both.back().insert(both.back().end(), uniform.back().begin(),
                       uniform.back().end());
  }
  if (finest.size() < 2) {
    return absl::FailedPreconditionError(absl::StrFormat(
        "scales need 2 graphs with component levels, got %d", finest.size()));
  }
  FrozenScales scales;
  scales.deviation = Deviations(both);
  scales.component = MeanDistances(finest, scales.deviation);
  scales.uniform = MeanDistances(uniform, scales.deviation);
  scales.partial = MeanDistances(both, scales.deviation);
  return scales;
}

std::string FormatFrozenScales(const FrozenScales& scales) {
  std::string out = "constexpr FrozenScales kFrozenScales = {\n";
  AppendArray(scales.deviation, out);
  AppendArray(scales.component, out);
  AppendArray(scales.uniform, out);
  AppendArray(scales.partial, out);
  return out + "};\n";
}

}  // namespace argmesh
