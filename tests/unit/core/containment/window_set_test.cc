#include "core/containment/window_set.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace argmesh {
namespace {

TEST(PackedPoint, KeepsPositionsAndDirections) {
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    Eigen::Vector3f position;
    Eigen::Vector3f normal;
    for (int k = 0; k < 3; ++k) {
      position[k] = static_cast<float>(random.Uniform(-2, 2));
      normal[k] = static_cast<float>(random.Normal());
    }
    normal.normalize();
    const PackedPoint packed = PackPoint(position, normal);
    EXPECT_LE((UnpackPosition(packed) - position).lpNorm<Eigen::Infinity>(),
              0.51F * kPositionStep);
    EXPECT_GT(UnpackNormal(packed).dot(normal), 0.9995F);
    EXPECT_NEAR(UnpackNormal(packed).norm(), 1, 1e-6);
  }
}

TEST(PackedPoint, KeepsTheAxes) {
  for (int k = 0; k < 3; ++k) {
    for (const float sign : {-1.0F, 1.0F}) {
      const Eigen::Vector3f axis = sign * Eigen::Vector3f::Unit(k);
      const PackedPoint packed = PackPoint(Eigen::Vector3f::Zero(), axis);
      EXPECT_LT((UnpackNormal(packed) - axis).norm(), 1e-6F);
    }
  }
}

TEST(PackedPoint, MovesWhatIsTooFarOutToTheEdge) {
  const PackedPoint packed =
      PackPoint(Eigen::Vector3f(100, -100, 0), Eigen::Vector3f::UnitZ());
  EXPECT_NEAR(UnpackPosition(packed).x(), 16, 0.001);
  EXPECT_NEAR(UnpackPosition(packed).y(), -16, 0.001);
}

}  // namespace
}  // namespace argmesh
