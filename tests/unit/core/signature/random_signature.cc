#include "tests/unit/core/signature/random_signature.h"

#include <Eigen/Core>
#include <vector>

#include "core/base/random.h"

namespace argmesh {
namespace {

void NormalizePart(std::vector<float>& part) {
  Eigen::Map<Eigen::VectorXf> vector(part.data(),
                                     static_cast<Eigen::Index>(part.size()));
  vector.normalize();
  for (float& value : part) value = static_cast<float>(Eigen::half(value));
}

void AddNoise(std::vector<float>& part, double amount, Random& random) {
  const double share = amount / std::sqrt(static_cast<double>(part.size()));
  for (float& value : part)
    value += static_cast<float>(share * random.Normal());
  NormalizePart(part);
}

}  // namespace

ShapeSignature MakeRandomSignature(uint64_t seed) {
  Random random(seed);
  ShapeSignature signature;
  signature.point.assign(kPointDims, 0);
  signature.view.assign(kViewDims, 0);
  AddNoise(signature.point, 1, random);
  AddNoise(signature.view, 1, random);
  for (float& value : signature.chirality) {
    value = static_cast<float>(random.Uniform(-0.5, 0.5));
  }
  signature.smoothed = random.Below(2) == 1;
  return signature;
}

ShapeSignature PerturbSignature(const ShapeSignature& signature, float amount,
                                uint64_t seed) {
  Random random(seed);
  ShapeSignature changed = signature;
  AddNoise(changed.point, static_cast<double>(amount), random);
  AddNoise(changed.view, static_cast<double>(amount), random);
  return changed;
}

}  // namespace argmesh
