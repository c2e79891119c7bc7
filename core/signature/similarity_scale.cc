#include "core/signature/similarity_scale.h"

#include <cmath>

namespace argmesh {

double ScaledSimilarity(const SimilarityScale& scale, double squared_distance) {
  const double share = squared_distance / (scale.half * scale.half);
  return 1 / (1 + std::pow(share, scale.steepness / 2));
}

}  // namespace argmesh
