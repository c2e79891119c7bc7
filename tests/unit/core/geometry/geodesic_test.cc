#include "core/geometry/geodesic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "core/geometry/area.h"
#include "tests/unit/core/geometry/closed_form_meshes.h"

namespace argmesh {
namespace {

// Distances by relaxing every link until nothing changes.
std::vector<double> BellmanFord(const SurfaceGraph& graph, int source) {
  std::vector<double> distance(static_cast<size_t>(graph.num_vertices()),
                               std::numeric_limits<double>::infinity());
  distance.data()[source] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (int v = 0; v < graph.num_vertices(); ++v) {
      for (int32_t e = graph.offsets.data()[v]; e < graph.offsets.data()[v + 1];
           ++e) {
        const double through = distance.data()[v] + graph.lengths.data()[e];
        double& target = distance.data()[graph.targets.data()[e]];
        if (through < target - 1e-12) {
          target = through;
          changed = true;
        }
      }
    }
  }
  return distance;
}

// Mean and largest ratio of found to exact distance over the targets that are
// at least `min_distance` away.
struct Ratio {
  double mean = 0;
  double least = std::numeric_limits<double>::infinity();
  double largest = 0;
};

template <typename Exact>
Ratio CompareWithExact(const SurfaceGraph& graph, int source,
                       double min_distance, const Exact& exact) {
  Ratio ratio;
  int count = 0;
  GeodesicSolver solver(graph);
  for (const auto& [v, distance] : solver.FindWithin(source)) {
    const double expected = exact(v);
    if (expected < min_distance) continue;
    const double r = static_cast<double>(distance) / expected;
    ratio.mean += r;
    ratio.least = std::min(ratio.least, r);
    ratio.largest = std::max(ratio.largest, r);
    ++count;
  }
  ratio.mean /= count;
  return ratio;
}

TEST(GeodesicSolver, FindsShortestPathsOfTheGraph) {
  const TriangleMesh mesh = MakeIrregularSphere(6, 1, 21);
  const SurfaceGraph graph = BuildSurfaceGraph(mesh);
  GeodesicSolver solver(graph);
  for (const int source : {0, 17, 200}) {
    const std::vector<double> expected = BellmanFord(graph, source);
    const auto reached = solver.FindWithin(source);
    ASSERT_EQ(reached.size(), expected.size());
    for (const auto& [v, distance] : reached) {
      EXPECT_NEAR(distance, expected.data()[v], 1e-5);
    }
  }
}

TEST(GeodesicSolver, ReachesExactlyTheBallNearestFirst) {
  const SurfaceGraph graph = BuildSurfaceGraph(MakeIrregularSphere(6, 1, 22));
  const std::vector<double> expected = BellmanFord(graph, 5);
  GeodesicSolver solver(graph);
  solver.FindWithin(100);  // leaves nothing behind
  for (const double radius : {0.0, 0.3, 1.0, 2.0}) {
    const auto reached = solver.FindWithin(5, static_cast<float>(radius));
    EXPECT_TRUE(std::is_sorted(
        reached.begin(), reached.end(), [](const auto& a, const auto& b) {
          return a.distance != b.distance ? a.distance < b.distance
                                          : a.vertex < b.vertex;
        }));
    const auto inside = std::count_if(expected.begin(), expected.end(),
                                      [&](double d) { return d <= radius; });
    EXPECT_EQ(static_cast<std::ptrdiff_t>(reached.size()), inside) << radius;
    EXPECT_EQ(reached.front().vertex, 5);
    EXPECT_EQ(reached.front().distance, 0);
  }
}

TEST(GeodesicSolver, BallsAreSymmetric) {
  const SurfaceGraph graph = BuildSurfaceGraph(MakeTorus(1, 0.4, 24, 12));
  const int n = graph.num_vertices();
  Eigen::MatrixXf distance(n, n);
  GeodesicSolver solver(graph);
  for (int v = 0; v < n; ++v) {
    for (const auto& r : solver.FindWithin(v)) {
      distance(v, r.vertex) = r.distance;
    }
  }
  EXPECT_LT((distance - distance.transpose()).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(GeodesicSolver, StaysInTheRegionOfTheSource) {
  const SurfaceGraph graph = BuildSurfaceGraph(MakeGrid(1, 10, 3));
  // A wall at i == 5 and 6 with a gate at j == 10; diagonals leap over one row.
  std::vector<int32_t> region(121, 7);
  for (size_t j = 0; j < 10; ++j) region[5 * 11 + j] = region[6 * 11 + j] = 8;
  GeodesicSolver solver(graph);
  const auto reached = solver.FindWithinRegion(0, region);
  EXPECT_EQ(reached.size(), 101U);
  const auto behind =
      std::find_if(reached.begin(), reached.end(),
                   [](const auto& r) { return r.vertex == 110; });
  ASSERT_NE(behind, reached.end());
  EXPECT_GT(behind->distance,
            std::sqrt(0.25 + 1) + 0.1 + std::sqrt(0.16 + 1) - 1e-4);
  EXPECT_EQ(solver.FindWithinRegion(5 * 11, region).size(), 20U);
}

TEST(GeodesicSolver, IsNearlyExactOnAPlane) {
  const TriangleMesh mesh = MakeGrid(1, 40, 4);
  const auto exact = [&](int v) { return mesh.vertex(v).norm(); };
  const Ratio with = CompareWithExact(BuildSurfaceGraph(mesh), 0, 0.2, exact);
  EXPECT_GT(with.least, 1 - 1e-5);
  EXPECT_LT(with.mean, 1.05);
  EXPECT_LT(with.largest, 1.083);  // 1 / cos(22.5 degrees): king's moves
  const Ratio without = CompareWithExact(
      BuildSurfaceGraph(mesh, {.diagonals = false}), 0, 0.2, exact);
  EXPECT_GT(without.mean, with.mean + 0.02);
}

TEST(GeodesicSolver, IsNearlyExactOnASphere) {
  const TriangleMesh mesh = MakeIrregularSphere(17, 1, 23);
  const Ratio ratio =
      CompareWithExact(BuildSurfaceGraph(mesh), 0, 0.3, [&](int v) {
        return std::acos(
            std::clamp(mesh.vertex(v).dot(mesh.vertex(0)), -1.0, 1.0));
      });
  EXPECT_LT(ratio.mean, 1.05);
  EXPECT_GT(ratio.least, 0.99);  // chords are shorter than arcs
}

TEST(GeodesicSolver, IsNearlyExactOnACylinder) {
  const TriangleMesh mesh = MakeOpenCylinder(1, 4, 60, 45, true);
  const int source = 22 * 60;
  const Eigen::Vector3d from = mesh.vertex(source);
  const Ratio ratio =
      CompareWithExact(BuildSurfaceGraph(mesh), source, 0.3, [&](int v) {
        const Eigen::Vector3d to = mesh.vertex(v);
        double angle = std::abs(std::atan2(to.y(), to.x()) -
                                std::atan2(from.y(), from.x()));
        angle = std::min(angle, 2 * std::numbers::pi - angle);
        return std::hypot(angle, to.z() - from.z());
      });
  EXPECT_LT(ratio.mean, 1.05);
  EXPECT_GT(ratio.least, 0.99);
}

TEST(ComputeFarthestPointCells, CoverAndPackTheSurface) {
  const SurfaceGraph graph = BuildSurfaceGraph(MakeIrregularSphere(10, 1, 24));
  const FarthestPointCells cells = ComputeFarthestPointCells(graph, 30, 3);
  ASSERT_EQ(cells.seeds.size(), 30U);
  EXPECT_EQ(cells.seeds[0], 3);
  const float cover =
      *std::max_element(cells.distance.begin(), cells.distance.end());
  GeodesicSolver solver(graph);
  Eigen::MatrixXf to_vertex(30, graph.num_vertices());
  for (size_t s = 0; s < 30; ++s) {
    for (const auto& r : solver.FindWithin(cells.seeds[s])) {
      to_vertex(static_cast<Eigen::Index>(s), r.vertex) = r.distance;
    }
  }
  for (int v = 0; v < graph.num_vertices(); ++v) {
    const float nearest = to_vertex.col(v).minCoeff();
    EXPECT_NEAR(cells.distance.data()[v], nearest, 1e-5);
    EXPECT_NEAR(to_vertex(cells.cell_of_vertex.data()[v], v), nearest, 1e-5);
  }
  // Seeds are as far from each other as any vertex is from its seed.
  for (int a = 0; a < 30; ++a) {
    for (int b = 0; b < a; ++b) {
      EXPECT_GE(to_vertex(a, cells.seeds.data()[b]), cover - 1e-5F);
    }
  }
}

TEST(ComputeFarthestPointCells, EndsWhenEveryVertexIsASeed) {
  const SurfaceGraph graph = BuildSurfaceGraph(MakeIcosphere(1, 1));
  const FarthestPointCells cells = ComputeFarthestPointCells(graph, 50, 0);
  EXPECT_EQ(cells.seeds.size(), 12U);
  for (const float distance : cells.distance) EXPECT_EQ(distance, 0);
}

TEST(ComputeFarthestPointCells, SeedsEveryComponentFirst) {
  const TriangleMesh a = MakeIcosphere(2, 1);
  const TriangleMesh b = Moved(a, Eigen::Matrix3d::Identity(), 1, {50, 0, 0});
  const SurfaceGraph graph = BuildSurfaceGraph(Join(a, b), {.bridges = false});
  const FarthestPointCells cells = ComputeFarthestPointCells(graph, 2, 0);
  EXPECT_EQ(cells.seeds[1], a.num_vertices());
}

TEST(ComputeAverageGeodesicDistance, IsHalfTheCircumferenceOnASphere) {
  const double radius = 2;
  const TriangleMesh mesh = MakeIrregularSphere(17, radius, 25);
  const Eigen::VectorXd average = ComputeAverageGeodesicDistance(
      BuildSurfaceGraph(mesh), ComputeVertexAreas(mesh));
  EXPECT_NEAR(average.mean(), std::numbers::pi * radius / 2,
              0.03 * std::numbers::pi * radius / 2);
  EXPECT_GT(average.minCoeff(), 0.94 * std::numbers::pi * radius / 2);
  EXPECT_LT(average.maxCoeff(), 1.08 * std::numbers::pi * radius / 2);
}

TEST(ComputeAverageGeodesicDistance, IsLeastInTheMiddleOfATube) {
  const TriangleMesh mesh = MakeOpenCylinder(0.2, 4, 16, 41, true);
  const Eigen::VectorXd average = ComputeAverageGeodesicDistance(
      BuildSurfaceGraph(mesh), ComputeVertexAreas(mesh));
  // Along a line of length 4: (z^2 + (4 - z)^2) / 8.
  EXPECT_NEAR(average[20 * 16], 1.0, 0.12);
  EXPECT_NEAR(average[0], 2.0, 0.15);
}

TEST(ComputeAverageGeodesicDistance, IsFiniteWithoutBridges) {
  const TriangleMesh a = MakeIcosphere(3, 1);
  const TriangleMesh mesh =
      Join(a, Moved(a, Eigen::Matrix3d::Identity(), 1, {50, 0, 0}));
  const Eigen::VectorXd average = ComputeAverageGeodesicDistance(
      BuildSurfaceGraph(mesh, {.bridges = false}), ComputeVertexAreas(mesh));
  // Half the surface at pi/2 on average, half at the largest distance.
  EXPECT_NEAR(average.mean(), (std::numbers::pi / 2 + std::numbers::pi) / 2,
              0.2);
}

TEST(ComputeAverageGeodesicDistance, RepeatsBitForBitAndScales) {
  const TriangleMesh mesh = MakeTorus(1, 0.4, 40, 16);
  const SurfaceGraph graph = BuildSurfaceGraph(mesh);
  const Eigen::VectorXd areas = ComputeVertexAreas(mesh);
  const Eigen::VectorXd a = ComputeAverageGeodesicDistance(graph, areas);
  EXPECT_EQ(a, ComputeAverageGeodesicDistance(graph, areas));
  const TriangleMesh moved = Moved(mesh, RandomRotation(26), 4, {1, 2, 3});
  const Eigen::VectorXd b = ComputeAverageGeodesicDistance(
      BuildSurfaceGraph(moved), ComputeVertexAreas(moved));
  EXPECT_LT((b / 4 - a).cwiseAbs().maxCoeff(), 0.02 * a.mean());
}

}  // namespace
}  // namespace argmesh
