// The scales that attribute distances are measured on. Frozen: scales taken
// from the collection at hand would change every score whenever it grows.
#ifndef ARGMESH_CORE_MATCHING_FROZEN_SCALES_H_
#define ARGMESH_CORE_MATCHING_FROZEN_SCALES_H_

#include <array>
#include <span>
#include <string>

#include "absl/status/statusor.h"
#include "core/graph/shape_graph.h"
#include "core/matching/attribute_groups.h"

namespace argmesh {

// The distance of two nodes in a group is mean |x_k - y_k| / deviation_k; each
// scale is the mean of it over random pairs of nodes.
struct FrozenScales {
  // Standard deviation of each dimension, 1 for histograms.
  std::array<float, kAttributeDims> deviation{};
  std::array<float, kNumAttributeGroups> component{};  // finest component level
  std::array<float, kNumAttributeGroups> uniform{};    // uniform level
  std::array<float, kNumAttributeGroups> partial{};    // both mixed
};

const FrozenScales& DefaultFrozenScales();

// Scales of a collection: deviations over all nodes of the finest component
// levels and the uniform levels, scales over 20,000 seeded pairs of nodes of
// different graphs.
//
// Fails    kFailedPrecondition  fewer than 2 graphs with component levels
// Cost     O(nodes + pairs). Thread-safe.
absl::StatusOr<FrozenScales> ComputeFrozenScales(
    std::span<const ShapeGraph> graphs);

// The scales as the C++ initialisers of frozen_scales.cc.
std::string FormatFrozenScales(const FrozenScales& scales);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MATCHING_FROZEN_SCALES_H_
