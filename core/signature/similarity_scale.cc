#include "core/signature/similarity_scale.h"

#include <cmath>

namespace argmesh {
namespace {

constexpr double kHalfDistance = 0.9;
constexpr double kSteepness = 6;

}  // namespace

double SimilarityOfDistance(double distance) {
  return 1 / (1 + std::pow(distance / kHalfDistance, kSteepness));
}

}  // namespace argmesh
