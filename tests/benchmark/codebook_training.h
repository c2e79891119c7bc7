// Making a window codebook from the windows of training shapes.
//
// Without labels: the mean of raw descriptors; each of the three histograms
// divided by the root of its total variance; the 24 principal directions, each
// times variance^-1/4; words by k-means.
//
// Repeats  equal shapes in equal order give bit-equal codebooks.
#ifndef ARGMESH_TESTS_BENCHMARK_CODEBOOK_TRAINING_H_
#define ARGMESH_TESTS_BENCHMARK_CODEBOOK_TRAINING_H_

#include <array>
#include <cstdint>
#include <vector>

#include "core/containment/window_codebook.h"
#include "core/containment/window_descriptor.h"

namespace argmesh {

// Of one shape, by target level.
using TrainingShape = std::array<std::vector<RawDescriptor>, kNumTargetLevels>;

WindowCodebook TrainWindowCodebook(const std::vector<TrainingShape>& shapes,
                                   uint64_t seed, int threads);

}  // namespace argmesh

#endif  // ARGMESH_TESTS_BENCHMARK_CODEBOOK_TRAINING_H_
