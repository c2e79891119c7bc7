#include "core/signature/signature_similarity.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/signature/similarity_scale.h"

namespace argmesh {
namespace {

constexpr double kFixedPoint = 1 << 14;  // of a length of 1

double SquaredDistance(const std::vector<float>& a,
                       const std::vector<float>& b) {
  double squared = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    const double difference =
        static_cast<double>(a[i]) - static_cast<double>(b[i]);
    squared += difference * difference;
  }
  return squared;
}

// No sum of products overflows: vectors are at most 2^14 long.
int32_t Dot(const std::vector<int16_t>& a, const std::vector<int16_t>& b) {
  int32_t sum = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    sum += static_cast<int32_t>(a[i]) * static_cast<int32_t>(b[i]);
  }
  return sum;
}

}  // namespace

double SignatureSimilarity(const ShapeSignature& a, const ShapeSignature& b) {
  return SimilarityOfDistance(
      std::sqrt(kPointShare * SquaredDistance(a.point, b.point) +
                kViewShare * SquaredDistance(a.view, b.view)));
}

PackedSignature::PackedSignature(const ShapeSignature& signature)
    : chirality_(signature.chirality) {
  values_.reserve(kSignatureDims);
  const auto append = [this](const std::vector<float>& part, double share) {
    const double scale = std::sqrt(share) * kFixedPoint;
    for (const float value : part) {
      values_.push_back(static_cast<int16_t>(
          std::lround(static_cast<double>(value) * scale)));
    }
  };
  append(signature.point, kPointShare);
  append(signature.view, kViewShare);
  squared_ = Dot(values_, values_);
}

double SignatureSimilarity(const PackedSignature& a, const PackedSignature& b) {
  const double squared =
      (static_cast<double>(a.squared_) + static_cast<double>(b.squared_) -
       2 * static_cast<double>(Dot(a.values_, b.values_))) /
      (kFixedPoint * kFixedPoint);
  return SimilarityOfDistance(std::sqrt(std::max(0.0, squared)));
}

}  // namespace argmesh
