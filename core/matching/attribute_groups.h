// The attributes of a node as groups of numbers that can be compared:
// histograms cumulated, so that their L1 distance is an earth mover's.
#ifndef ARGMESH_CORE_MATCHING_ATTRIBUTE_GROUPS_H_
#define ARGMESH_CORE_MATCHING_ATTRIBUTE_GROUPS_H_

#include <array>
#include <cstddef>

#include "core/graph/shape_graph.h"

namespace argmesh {

enum AttributeGroup : size_t {
  kTupleGroup,  // the paper's V_c without the area
  kAreaGroup,   // log2 of the relative area, >= log2(1e-4)
  kShapeDiameterGroup,
  kAverageGeodesicGroup,
  kShapeIndexGroup,
  kCurvednessGroup,
  kOuterDistanceGroup,
  kInternalDistanceGroup,
  kWaveKernelGroup,
  kRelativeDiameterGroup,
  kNumAttributeGroups
};

struct GroupShape {
  const char* name;
  size_t dims;
  bool histogram;        // cumulated, already on one scale
  float full_weight;     // in whole-shape matching
  float tuple_weight;    // in whole-shape matching by the paper's tuple alone
  float partial_weight;  // in partial matching
};

inline constexpr std::array<GroupShape, kNumAttributeGroups> kGroups = {{
    {"tuple", 7, false, 0.5F, 0.5F, 1.0F},
    {"area", 1, false, 0.5F, 0.5F, 0.0F},
    {"shape_diameter", 10, true, 1.0F, 0.0F, 0.0F},
    {"average_geodesic", 10, true, 1.0F, 0.0F, 0.0F},
    {"shape_index", 9, true, 1.0F, 0.0F, 1.0F},
    {"curvedness", 8, true, 1.0F, 0.0F, 0.0F},
    {"outer_distance", 10, true, 1.0F, 0.0F, 0.0F},
    {"internal_distance", 10, true, 1.0F, 0.0F, 1.0F},
    {"wave_kernel", 16, false, 1.0F, 0.0F, 0.0F},
    {"relative_diameter", 10, true, 0.0F, 0.0F, 1.0F},
}};

constexpr size_t GroupOffset(size_t group) {
  size_t offset = 0;
  for (size_t g = 0; g < group; ++g) offset += kGroups[g].dims;
  return offset;
}

inline constexpr size_t kAttributeDims = GroupOffset(kNumAttributeGroups);

using AttributeVector = std::array<float, kAttributeDims>;

// Group after group, unscaled.
AttributeVector ExtractAttributes(const ArgNode& node);

}  // namespace argmesh

#endif  // ARGMESH_CORE_MATCHING_ATTRIBUTE_GROUPS_H_
