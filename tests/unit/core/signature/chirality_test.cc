#include "core/signature/chirality.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/synthesis/mesh_noise.h"
#include "core/synthesis/mesh_similarity.h"
#include "core/synthesis/sample_shape.h"
#include "tests/support/status_matchers.h"
#include "tests/support/test_meshes.h"

namespace argmesh {
namespace {

using Chirality = std::array<float, kChiralDims>;

TriangleMesh Mirrored(TriangleMesh mesh) {
  mesh.V.col(0) *= -1;
  mesh.F.col(1).swap(mesh.F.col(2));
  return mesh;
}

// Three different arms on three axes: no plane of symmetry.
TriangleMesh MakeTripod() {
  TriangleMesh mesh = MakeSheet(24);
  for (Eigen::Index v = 0; v < mesh.V.rows(); ++v) {
    const double x = mesh.V(v, 0);
    const double y = mesh.V(v, 1);
    mesh.V(v, 0) = 2 * x;
    mesh.V(v, 2) = x * x * std::sin(4 * y) + 0.5 * x * y;
  }
  return mesh;
}

double Length(const Chirality& chirality) {
  double squared = 0;
  for (const float value : chirality) {
    squared += static_cast<double>(value) * static_cast<double>(value);
  }
  return std::sqrt(squared);
}

TEST(MeasureChirality, ChangesSignInTheMirrorAndNothingElse) {
  const TriangleMesh mesh = MakeTripod();
  const Chirality chirality = MeasureChirality(mesh);
  const Chirality mirrored = MeasureChirality(Mirrored(mesh));
  EXPECT_GT(Length(chirality), 0.05);
  for (size_t i = 0; i < chirality.size(); ++i) {
    EXPECT_NEAR(mirrored[i], -chirality[i], 1e-5) << i;
  }
}

TEST(MeasureChirality, IgnoresMotionScaleAndNumbering) {
  const TriangleMesh mesh = MakeTripod();
  const Chirality chirality = MeasureChirality(mesh);
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    const Chirality copy = MeasureChirality(RandomSimilarity(mesh, seed));
    for (size_t i = 0; i < chirality.size(); ++i) {
      EXPECT_NEAR(copy[i], chirality[i], 1e-5) << i;
    }
  }
}

TEST(MeasureChirality, IsNothingForSymmetricShapes) {
  EXPECT_LT(Length(MeasureChirality(MakeTorus(1, 0.4, 32, 16))), 1e-3);
  EXPECT_LT(Length(MeasureChirality(MakeDumbbell())), 1e-3);
  EXPECT_LT(Length(MeasureChirality(MakeSheet(5))), 1e-3);
}

TEST(MeasureChirality, HardlyMovesWithNoise) {
  const TriangleMesh mesh = MakeTripod();
  const Chirality chirality = MeasureChirality(mesh);
  const Chirality noisy = MeasureChirality(AddNoise(mesh, 0.005, 1));
  Chirality difference;
  for (size_t i = 0; i < chirality.size(); ++i) {
    difference[i] = noisy[i] - chirality[i];
  }
  EXPECT_LT(Length(difference), 0.2 * Length(chirality));
}

}  // namespace
}  // namespace argmesh
