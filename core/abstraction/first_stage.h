// What the first stage of every decomposition gives to the second: a label per
// sample, the modes behind the labels, and how strongly neighbours belong
// together.
#ifndef ARGMESH_CORE_ABSTRACTION_FIRST_STAGE_H_
#define ARGMESH_CORE_ABSTRACTION_FIRST_STAGE_H_

#include <cstdint>
#include <vector>

#include "absl/status/statusor.h"
#include "core/abstraction/decomposition.h"
#include "core/base/stop_token.h"

namespace argmesh {

struct FirstStage {
  std::vector<int32_t> label_of_sample;  // any non-negative numbers
  std::vector<Mode> modes;               // `region` still unset
  std::vector<double> link_weights;      // per link of edge_graph, > 0
};

// Mean shift in biharmonic position and log shape diameter.
absl::StatusOr<FirstStage> FindBiharmonicModes(const DecompositionInput& input,
                                               const BiharmonicOptions& options,
                                               const StopToken& stop);

// Mean shift in position, normal, mean and Gaussian curvature.
absl::StatusOr<FirstStage> FindNormalCurvatureModes(
    const DecompositionInput& input, const NormalCurvatureOptions& options,
    const StopToken& stop);

}  // namespace argmesh

#endif  // ARGMESH_CORE_ABSTRACTION_FIRST_STAGE_H_
