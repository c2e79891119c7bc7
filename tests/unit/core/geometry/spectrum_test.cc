#include "core/geometry/spectrum.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "core/geometry/area.h"
#include "tests/support/status_matchers.h"
#include "tests/unit/core/geometry/closed_form_meshes.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

struct Operator {
  Eigen::SparseMatrix<double> laplacian;
  Eigen::VectorXd areas;
};

Operator MakeOperator(const TriangleMesh& mesh) {
  const SurfaceGraph graph = BuildSurfaceGraph(mesh);
  return {BuildLaplacian(graph, ComputeCotangentWeights(mesh, graph)),
          ComputeVertexAreas(mesh)};
}

absl::StatusOr<Spectrum> Compute(const TriangleMesh& mesh, int count) {
  const Operator op = MakeOperator(mesh);
  return ComputeSpectrum(op.laplacian, op.areas, count);
}

TriangleMesh UnitArea(TriangleMesh mesh) {
  mesh.V /= std::sqrt(ComputeFaceAreas(mesh).sum());
  return mesh;
}

double WeightOf(const SurfaceGraph& graph, const std::vector<double>& weights,
                int from, int to) {
  for (int32_t e = graph.offsets.data()[from];
       e < graph.offsets.data()[from + 1]; ++e) {
    if (graph.targets.data()[e] == to) return weights.data()[e];
  }
  return std::nan("");
}

TEST(ComputeCotangentWeights, AreTheCotangentsOfASquare) {
  const TriangleMesh mesh = MakeGrid(1, 1, 1);
  const SurfaceGraph graph = BuildSurfaceGraph(mesh);
  const auto weights = ComputeCotangentWeights(mesh, graph);
  // Sides face one angle of 45 degrees; the drawn diagonal two of 90, raised
  // to the floor; the other diagonal is no edge.
  EXPECT_NEAR(WeightOf(graph, weights, 0, 1), 0.5, 1e-12);
  EXPECT_NEAR(WeightOf(graph, weights, 2, 3), 0.5, 1e-12);
  const double a = WeightOf(graph, weights, 0, 3);
  const double b = WeightOf(graph, weights, 1, 2);
  EXPECT_NEAR(std::max(a, b), 0.01, 1e-12);
  EXPECT_EQ(std::min(a, b), 0);
}

TEST(ComputeCotangentWeights, AreClampedAndGiveBridgesTheirOwn) {
  const TriangleMesh ball = MakeIrregularSphere(3, 1, 51);
  const TriangleMesh mesh =
      Join(ball, Moved(ball, Eigen::Matrix3d::Identity(), 1, {3, 0, 0}));
  const SurfaceGraph graph = BuildSurfaceGraph(mesh);
  const auto weights = ComputeCotangentWeights(
      mesh, graph, {.min_weight = 0.4, .max_weight = 0.7, .bridge_weight = 3});
  int bridges = 0;
  for (size_t e = 0; e < weights.size(); ++e) {
    switch (graph.kinds[e]) {
      case LinkKind::kEdge:
        EXPECT_GE(weights[e], 0.4);
        EXPECT_LE(weights[e], 0.7);
        break;
      case LinkKind::kDiagonal:
        EXPECT_EQ(weights[e], 0);
        break;
      case LinkKind::kBridge:
        EXPECT_EQ(weights[e], 3);
        ++bridges;
        break;
    }
  }
  EXPECT_GE(bridges, 2);
}

TEST(BuildLaplacian, IsSymmetricWithRowsThatSumToZero) {
  const TriangleMesh ball = MakeIrregularSphere(4, 1, 52);
  const Operator op = MakeOperator(
      Join(ball, Moved(ball, Eigen::Matrix3d::Identity(), 1, {4, 0, 0})));
  const Eigen::MatrixXd L(op.laplacian);
  EXPECT_EQ(L, L.transpose());
  EXPECT_LT(L.rowwise().sum().cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GE(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(L).eigenvalues()[0],
            -1e-12);
}

TEST(BuildLaplacian, GivesTheSecondDerivativeOnAGrid) {
  const TriangleMesh mesh = MakeGrid(1, 10, 53);
  const SurfaceGraph graph = BuildSurfaceGraph(mesh);
  const auto laplacian = BuildLaplacian(
      graph, ComputeCotangentWeights(mesh, graph, {.min_weight = 0}));
  const Eigen::VectorXd x_squared = mesh.V.col(0).cwiseAbs2();
  const Eigen::VectorXd second = -(laplacian * x_squared);
  // Five-point star: times the cell's area, for any drawn diagonals.
  for (int i = 1; i < 10; ++i) {
    for (int j = 1; j < 10; ++j) EXPECT_NEAR(second[i * 11 + j], 0.02, 1e-12);
  }
}

TEST(ComputeSpectrum, OfTheSphereIsThatOfSphericalHarmonics) {
  ASSERT_OK_AND_ASSIGN(const Spectrum spectrum,
                       Compute(UnitArea(MakeIrregularSphere(17, 1, 54)), 49));
  int k = 0;
  for (int l = 0; l < 7; ++l) {
    for (int m = 0; m < 2 * l + 1; ++m, ++k) {
      const double expected = l * (l + 1) * 4 * std::numbers::pi;
      EXPECT_NEAR(spectrum.values[k], expected, 0.03 * expected + 1e-6)
          << "l " << l << " k " << k;
    }
  }
}

TEST(ComputeSpectrum, SatisfiesItsEquationAndIsOrthonormal) {
  const Operator op = MakeOperator(UnitArea(MakeTorus(1, 0.4, 50, 20)));
  ASSERT_OK_AND_ASSIGN(const Spectrum s,
                       ComputeSpectrum(op.laplacian, op.areas, 40));
  ASSERT_EQ(s.values.size(), 40);
  const Eigen::MatrixXd MU = op.areas.asDiagonal() * s.vectors;
  EXPECT_LT((s.vectors.transpose() * MU - Eigen::MatrixXd::Identity(40, 40))
                .cwiseAbs()
                .maxCoeff(),
            1e-8);
  const Eigen::MatrixXd residual =
      op.laplacian * s.vectors - MU * s.values.asDiagonal();
  const Eigen::VectorXd scale = op.areas.cwiseSqrt().cwiseInverse();
  for (int k = 0; k < 40; ++k) {
    EXPECT_LT((scale.asDiagonal() * residual.col(k)).norm(),
              1e-4 * (1 + s.values[k]));
    if (k > 0) {
      EXPECT_GE(s.values[k], s.values[k - 1]);
    }
  }
  EXPECT_NEAR(s.values[0], 0, 1e-9);
}

// One Krylov space holds one vector of each eigenspace only; symmetric shapes
// have eigenvalues of multiplicity up to 5, equal components of more.
TEST(ComputeSpectrum, FindsEveryCopyOfAMultipleEigenvalue) {
  TriangleMesh three = MakeIcosphere(5, 1);
  three = Join(three, Moved(three, Eigen::Matrix3d::Identity(), 1, {3, 0, 0}));
  three = Join(three, Moved(MakeIcosphere(5, 1), Eigen::Matrix3d::Identity(), 1,
                            {0, 3, 0}));
  for (const TriangleMesh& mesh :
       {MakeIcosphere(7, 1), MakeTorus(1, 0.4, 30, 12), MakeBox({1, 1, 1}, .15),
        three}) {
    const Operator op = MakeOperator(UnitArea(mesh));
    const Eigen::VectorXd scale = op.areas.cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd S =
        scale.asDiagonal() * Eigen::MatrixXd(op.laplacian) * scale.asDiagonal();
    const Eigen::VectorXd expected =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(S,
                                                       Eigen::EigenvaluesOnly)
            .eigenvalues();
    for (const int count : {5, 20, 50}) {
      ASSERT_OK_AND_ASSIGN(const Spectrum s,
                           ComputeSpectrum(op.laplacian, op.areas, count));
      for (int k = 0; k < count; ++k) {
        ASSERT_NEAR(s.values[k], expected[k], 1e-6 * (1 + expected[k]))
            << "n " << mesh.num_vertices() << " k " << k << " of " << count;
      }
      EXPECT_LT((s.vectors.transpose() * op.areas.asDiagonal() * s.vectors -
                 Eigen::MatrixXd::Identity(count, count))
                    .cwiseAbs()
                    .maxCoeff(),
                1e-8);
    }
  }
}

TEST(ComputeSpectrum, FindsEveryPairOfTwoEqualComponents) {
  const TriangleMesh ball = MakeIcosphere(10, 1);
  const TriangleMesh mesh =
      Join(ball, Moved(ball, Eigen::Matrix3d::Identity(), 1, {3, 0, 0}));
  const SurfaceGraph graph = BuildSurfaceGraph(mesh, {.bridges = false});
  ASSERT_OK_AND_ASSIGN(
      const Spectrum s,
      ComputeSpectrum(
          BuildLaplacian(graph, ComputeCotangentWeights(mesh, graph)),
          ComputeVertexAreas(mesh), 60));
  for (int k = 0; k < 60; k += 2) {
    EXPECT_NEAR(s.values[k], s.values[k + 1], 1e-6 * (1 + s.values[k]));
  }
  // l = 0 .. 4 twice, then l = 5.
  EXPECT_NEAR(s.values[49], 20, 0.6);
  EXPECT_NEAR(s.values[50], 30, 0.9);
}

TEST(ComputeSpectrum, TakesAllButTwoPairsOfASmallMesh) {
  ASSERT_OK_AND_ASSIGN(const Spectrum s, Compute(MakeIcosphere(1, 1), 10));
  EXPECT_EQ(s.values.size(), 10);
  EXPECT_NEAR(s.values[0], 0, 1e-12);
  EXPECT_NEAR(s.values[1], s.values[3], 1e-9);  // three coordinates
}

TEST(ComputeSpectrum, ScalesWithTheInverseArea) {
  const TriangleMesh mesh = MakeIrregularSphere(8, 1, 55);
  ASSERT_OK_AND_ASSIGN(const Spectrum a, Compute(mesh, 20));
  ASSERT_OK_AND_ASSIGN(
      const Spectrum b,
      Compute(Moved(mesh, RandomRotation(55), 100, {1, 2, 3}), 20));
  for (int k = 1; k < 20; ++k) {
    EXPECT_NEAR(b.values[k] * 1e4 / a.values[k], 1, 1e-6);
  }
}

TEST(ComputeSpectrum, HasOneNearZeroPairForEveryUnconnectedComponent) {
  const TriangleMesh ball = MakeIrregularSphere(5, 1, 56);
  const TriangleMesh mesh =
      Join(ball, Moved(ball, Eigen::Matrix3d::Identity(), 1, {9, 0, 0}));
  const SurfaceGraph graph = BuildSurfaceGraph(mesh, {.bridges = false});
  ASSERT_OK_AND_ASSIGN(
      const Spectrum s,
      ComputeSpectrum(
          BuildLaplacian(graph, ComputeCotangentWeights(mesh, graph)),
          ComputeVertexAreas(mesh), 12));
  EXPECT_NEAR(s.values[1], 0, 1e-9);
  EXPECT_GT(s.values[2], 1);
}

TEST(ComputeSpectrum, TakesVerticesWithoutArea) {
  Operator op = MakeOperator(UnitArea(MakeIrregularSphere(6, 1, 57)));
  op.areas[7] = 0;
  ASSERT_OK_AND_ASSIGN(const Spectrum s,
                       ComputeSpectrum(op.laplacian, op.areas, 20));
  EXPECT_TRUE(s.vectors.allFinite());
  EXPECT_NEAR(s.values[1], 8 * std::numbers::pi, 2);
}

TEST(ComputeSpectrum, RepeatsBitForBit) {
  const TriangleMesh mesh = UnitArea(MakeIcosphere(9, 1));
  ASSERT_OK_AND_ASSIGN(const Spectrum a, Compute(mesh, 40));
  ASSERT_OK_AND_ASSIGN(const Spectrum b, Compute(mesh, 40));
  EXPECT_EQ(a.values, b.values);
  EXPECT_EQ(a.vectors, b.vectors);
}

TEST(ComputeSpectrum, RefusesWhatItCannotAnswer) {
  const Operator op = MakeOperator(MakeIcosphere(2, 1));  // 42 vertices
  struct Row {
    int count;
    Eigen::VectorXd areas;
    const char* message;
  };
  for (const Row& row :
       {Row{0, op.areas, "0 eigenpairs"}, Row{-3, op.areas, "-3 eigenpairs"},
        Row{41, op.areas, "must be 1 .. 40"},
        Row{5, op.areas.head(41), "41 areas"},
        Row{5, Eigen::VectorXd::Zero(42), "sum to 0"}}) {
    EXPECT_THAT(
        ComputeSpectrum(op.laplacian, row.areas, row.count),
        StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr(row.message)));
  }
}

TEST(ComputeSpectrum, StopsWhenToldTo) {
  const Operator op = MakeOperator(MakeTorus(1, 0.4, 60, 30));
  EXPECT_EQ(ComputeSpectrum(op.laplacian, op.areas, 40,
                            StopToken({}, absl::InfinitePast()))
                .status()
                .code(),
            absl::StatusCode::kDeadlineExceeded);
}

TEST(ComputeWaveKernelSignature, IsOneOnAverageAndConstantOnASphere) {
  const TriangleMesh mesh = UnitArea(MakeIrregularSphere(14, 1, 58));
  // 49 pairs are whole eigenspaces: l = 0 .. 6.
  ASSERT_OK_AND_ASSIGN(const Spectrum s, Compute(mesh, 49));
  const Eigen::MatrixXd wks = ComputeWaveKernelSignature(s);
  ASSERT_EQ(wks.cols(), 16);
  const Eigen::VectorXd areas = ComputeVertexAreas(mesh);
  for (int j = 0; j < 16; ++j) {
    EXPECT_NEAR(wks.col(j).dot(areas), 1, 1e-6);
    EXPECT_LT((wks.col(j).array() - 1).abs().maxCoeff(), 0.15);
  }
}

TEST(ComputeWaveKernelSignature, IgnoresSignsAndRotationsInAnEigenspace) {
  const TriangleMesh mesh = UnitArea(MakeTorus(1, 0.4, 30, 15));
  ASSERT_OK_AND_ASSIGN(Spectrum s, Compute(mesh, 31));
  const Eigen::MatrixXd before = ComputeWaveKernelSignature(s);
  int turned = 0;
  for (int k = 1; k + 1 < 31; ++k) {
    s.vectors.col(k) *= -1;
    if (s.values[k + 1] - s.values[k] > 1e-8 * s.values[k]) continue;
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(0.7).toRotationMatrix();
    s.vectors.middleCols(k, 2) = (s.vectors.middleCols(k, 2) * turn).eval();
    ++turned;
  }
  EXPECT_GT(turned, 5);
  EXPECT_LT((ComputeWaveKernelSignature(s) - before).cwiseAbs().maxCoeff(),
            1e-6);
}

TEST(ComputeWaveKernelSignature, IgnoresRotationOfTheMesh) {
  const TriangleMesh mesh = UnitArea(MakeIrregularSphere(9, 1, 59));
  ASSERT_OK_AND_ASSIGN(const Spectrum a, Compute(mesh, 60));
  ASSERT_OK_AND_ASSIGN(
      const Spectrum b,
      Compute(Moved(mesh, RandomRotation(60), 1, {1, 2, 3}), 60));
  EXPECT_LT((ComputeWaveKernelSignature(a) - ComputeWaveKernelSignature(b))
                .cwiseAbs()
                .maxCoeff(),
            1e-3);
}

TEST(ComputeWaveKernelSignature, IsOneWhereNoEigenvalueIsNear) {
  Spectrum s{Eigen::Vector3d(0, 5, 6), Eigen::MatrixXd::Constant(4, 3, 2)};
  const Eigen::MatrixXd wks = ComputeWaveKernelSignature(s);
  EXPECT_NEAR(wks(0, 1), 4, 1e-9);
  EXPECT_EQ(wks(0, 15), 1);
  EXPECT_EQ(ComputeWaveKernelSignature(
                {Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Ones(4, 1)})
                .minCoeff(),
            1);
}

}  // namespace
}  // namespace argmesh
