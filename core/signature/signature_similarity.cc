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

// Of squared distances. Not above 1, whatever the rounding.
double MeanSimilarity(double point, double view) {
  return std::min(1.0,
                  kPointScale.weight * ScaledSimilarity(kPointScale, point) +
                      kViewScale.weight * ScaledSimilarity(kViewScale, view));
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
  return MeanSimilarity(SquaredDistance(a.point, b.point),
                        SquaredDistance(a.view, b.view));
}

PackedSignature::Part::Part(const std::vector<float>& numbers) {
  values.reserve(numbers.size());
  for (const float number : numbers) {
    values.push_back(static_cast<int16_t>(
        std::lround(static_cast<double>(number) * kFixedPoint)));
  }
  squared = Dot(values, values);
}

PackedSignature::PackedSignature(const ShapeSignature& signature)
    : point_(signature.point),
      view_(signature.view),
      chirality_(signature.chirality) {}

double PackedSignature::SquaredDistance(const Part& a, const Part& b) {
  const double squared =
      (static_cast<double>(a.squared) + static_cast<double>(b.squared) -
       2 * static_cast<double>(Dot(a.values, b.values))) /
      (kFixedPoint * kFixedPoint);
  return std::max(0.0, squared);
}

double SignatureSimilarity(const PackedSignature& a, const PackedSignature& b) {
  return MeanSimilarity(PackedSignature::SquaredDistance(a.point_, b.point_),
                        PackedSignature::SquaredDistance(a.view_, b.view_));
}

}  // namespace argmesh
