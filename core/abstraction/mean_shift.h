// Adaptive mean shift of weighted points in a Euclidean joint space, and the
// window ladder that gives every mode its largest stable window.
//
// Source   Comaniciu, Meer, "Mean Shift: A Robust Approach Toward Feature Space
//          Analysis", PAMI 24(5), 2002, and section 3.2 of the paper.
// Repeats  equal input gives bit-equal output; ties by index.
// Cost     O(steps * points^2 * dim). Thread-safe.
#ifndef ARGMESH_CORE_ABSTRACTION_MEAN_SHIFT_H_
#define ARGMESH_CORE_ABSTRACTION_MEAN_SHIFT_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/stop_token.h"

namespace argmesh {

struct MeanShiftOptions {
  double min_window = 0.03;     // w_MIN, > 0: bandwidth of the Gaussian kernel
  double max_window = 0.07;     // w_MAX, >= min_window
  double window_growth = 1.15;  // > 1
};

struct ShiftedMode {
  int32_t nearest_point = 0;  // the point nearest to the mode
  float window = 0;           // w_max: the last window at which it stood alone
  int32_t repeatability = 1;  // windows at which it stood alone
  float density = 0;          // share of the mass in the kernel at w_max
  float offset = 0;           // |delta(m)| / w when it was last tested
};

struct MeanShiftResult {
  std::vector<ShiftedMode> modes;         // found at w_MIN, densest first
  std::vector<int32_t> mode_of_point;     // the mode each point shifts to
  std::vector<int32_t> survivor_of_mode;  // the mode it is fused into at w_MAX
};

// `points` dim x n, `masses` n, >= 0, sum 1.
absl::StatusOr<MeanShiftResult> RunMeanShift(const Eigen::MatrixXf& points,
                                             const Eigen::VectorXf& masses,
                                             const MeanShiftOptions& options,
                                             const StopToken& stop);

}  // namespace argmesh

#endif  // ARGMESH_CORE_ABSTRACTION_MEAN_SHIFT_H_
