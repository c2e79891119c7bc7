#include "core/matching/attribute_groups.h"

#include <algorithm>
#include <span>

namespace argmesh {
namespace {

// Smaller nodes look equally small.
constexpr float kMinLog2Area = -13.287712F;  // log2(1e-4)

void PutCumulated(std::span<const float> histogram, float* out) {
  float sum = 0;
  for (const float share : histogram) {
    sum += share;
    *out++ = sum;
  }
}

}  // namespace

AttributeVector ExtractAttributes(const ArgNode& node) {
  AttributeVector x{};
  const NodeTuple& t = node.tuple;
  const float tuple[] = {t.normal_deviation, t.gauss_deviation,
                         t.gauss_mean,       t.mean_deviation,
                         t.mean_mean,        t.geodesic_deviation,
                         t.geodesic_mean};
  const auto at = [&x](AttributeGroup group) {
    return x.data() + GroupOffset(group);
  };
  std::copy(std::begin(tuple), std::end(tuple), at(kTupleGroup));
  *at(kAreaGroup) = std::max(t.log2_relative_area, kMinLog2Area);
  const NodeHistograms& h = node.histograms;
  PutCumulated(h.shape_diameter, at(kShapeDiameterGroup));
  PutCumulated(h.average_geodesic, at(kAverageGeodesicGroup));
  PutCumulated(h.shape_index, at(kShapeIndexGroup));
  PutCumulated(h.curvedness, at(kCurvednessGroup));
  PutCumulated(h.outer_distance, at(kOuterDistanceGroup));
  PutCumulated(h.internal_distance, at(kInternalDistanceGroup));
  std::copy(node.wave_kernel.begin(), node.wave_kernel.end(),
            at(kWaveKernelGroup));
  PutCumulated(h.relative_diameter, at(kRelativeDiameterGroup));
  return x;
}

}  // namespace argmesh
