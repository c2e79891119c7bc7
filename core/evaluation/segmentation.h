// How alike two segmentations of one surface are. Both give a label to every
// element (face or sample) of known area.
//
// Fails    kInvalidArgument  sizes that differ, a negative or infinite area,
//                            no area at all
// Cost     O(n log n). Thread-safe.
#ifndef ARGMESH_CORE_EVALUATION_SEGMENTATION_H_
#define ARGMESH_CORE_EVALUATION_SEGMENTATION_H_

#include <cstdint>
#include <span>

#include "absl/status/statusor.h"

namespace argmesh {

// 1 - Rand index, weighted by area: the chance that two random points of the
// surface are in one segment of one labelling and in two of the other.
// 0 .. 1, 0 for equal segmentations whatever their labels are called.
//
// Source   Rand, "Objective Criteria for the Evaluation of Clustering
//          Methods", JASA 66, 1971; Chen, Golovinskiy, Funkhouser, "A Benchmark
//          for 3D Mesh Segmentation", SIGGRAPH 2009. Theirs counts pairs of
//          faces; here pairs of points, so that tessellation does not matter.
absl::StatusOr<double> RandIndexError(std::span<const int32_t> labels,
                                      std::span<const int32_t> reference,
                                      std::span<const double> areas);

// The share of the area whose segment has a counterpart in `other`: a segment
// with intersection over union >= `min_overlap` by area. 0 .. 1; not
// symmetric.
absl::StatusOr<double> Repeatability(std::span<const int32_t> labels,
                                     std::span<const int32_t> other,
                                     std::span<const double> areas,
                                     double min_overlap = 0.5);

}  // namespace argmesh

#endif  // ARGMESH_CORE_EVALUATION_SEGMENTATION_H_
