#include <array>
#include <cmath>
#include <cstddef>

#include "core/signature/signature_similarity.h"

namespace argmesh {
namespace {

// Shapes of smaller chirality count as symmetric.
constexpr double kMinChirality = 0.05;
// How much closer to one than to the other must be: share of the distance.
constexpr double kClearly = 0.5;

using Chirality = std::array<float, kChiralDims>;

Handedness Compare(const Chirality& a, const Chirality& b) {
  double same = 0;
  double mirrored = 0;
  double length_a = 0;
  double length_b = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    const double x = static_cast<double>(a[i]);
    const double y = static_cast<double>(b[i]);
    same += (x - y) * (x - y);
    mirrored += (x + y) * (x + y);
    length_a += x * x;
    length_b += y * y;
  }
  if (std::sqrt(std::fmin(length_a, length_b)) < kMinChirality) {
    return Handedness::kUndecided;
  }
  if (std::sqrt(same) < kClearly * std::sqrt(mirrored)) {
    return Handedness::kSame;
  }
  if (std::sqrt(mirrored) < kClearly * std::sqrt(same)) {
    return Handedness::kMirrored;
  }
  return Handedness::kUndecided;
}

}  // namespace

Handedness CompareHandedness(const ShapeSignature& a, const ShapeSignature& b) {
  return Compare(a.chirality, b.chirality);
}

Handedness CompareHandedness(const PackedSignature& a,
                             const PackedSignature& b) {
  return Compare(a.chirality(), b.chirality());
}

}  // namespace argmesh
