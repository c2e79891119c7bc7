#include "core/signature/similarity_scale.h"

#include <cmath>

namespace argmesh {
namespace {

// From the 4,275 pairs of different classes among the odd-numbered meshes of a
// labelled collection (docs/algorithm.md): 1 of 100 is nearer than 1.05, which
// becomes 0.5, and 1 of 4,000 nearer than 0.85, which becomes 0.9.
constexpr double kHalfDistance = 1.05;
constexpr double kSteepness = 10.4;

}  // namespace

double SimilarityOfDistance(double distance) {
  return 1 / (1 + std::pow(distance / kHalfDistance, kSteepness));
}

}  // namespace argmesh
