#include "core/geometry/surface_graph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "core/geometry/geodesic.h"
#include "core/geometry/surface_bridges.h"
#include "tests/unit/core/geometry/closed_form_meshes.h"

namespace argmesh {
namespace {

struct LinkOf {
  float length;
  LinkKind kind;
};

std::map<std::pair<int, int>, LinkOf> LinksByPair(const SurfaceGraph& graph) {
  std::map<std::pair<int, int>, LinkOf> links;
  for (int v = 0; v < graph.num_vertices(); ++v) {
    for (int32_t e = graph.offsets.data()[v]; e < graph.offsets.data()[v + 1];
         ++e) {
      links.emplace(std::pair(v, graph.targets.data()[e]),
                    LinkOf{graph.lengths.data()[e], graph.kinds.data()[e]});
    }
  }
  return links;
}

int CountKind(const SurfaceGraph& graph, LinkKind kind) {
  return static_cast<int>(
      std::count(graph.kinds.begin(), graph.kinds.end(), kind));
}

// `count` triangles of size about `size` at random places in the unit cube.
TriangleMesh TriangleSoup(int count, double size, uint64_t seed) {
  Random random(seed);
  TriangleMesh mesh;
  mesh.V.resize(3 * count, 3);
  mesh.F.resize(count, 3);
  for (int f = 0; f < count; ++f) {
    const Eigen::RowVector3d centre(random.Uniform(), random.Uniform(),
                                    random.Uniform());
    for (int k = 0; k < 3; ++k) {
      mesh.V.row(3 * f + k) =
          centre + size * Eigen::RowVector3d(random.Uniform(-1, 1),
                                             random.Uniform(-1, 1),
                                             random.Uniform(-1, 1));
      mesh.F(f, k) = 3 * f + k;
    }
  }
  return mesh;
}

int ReachedFrom(const SurfaceGraph& graph, int source) {
  return static_cast<int>(GeodesicSolver(graph).FindWithin(source).size());
}

TEST(BuildSurfaceGraph, HasEveryLinkInBothDirectionsSortedAndOnce) {
  const TriangleMesh mesh =
      Join(MakeIrregularSphere(7, 1, 5), TriangleSoup(40, 0.3, 5));
  const SurfaceGraph graph = BuildSurfaceGraph(mesh);
  ASSERT_EQ(graph.num_vertices(), mesh.num_vertices());
  ASSERT_EQ(graph.lengths.size(), graph.targets.size());
  ASSERT_EQ(graph.kinds.size(), graph.targets.size());
  for (int v = 0; v < graph.num_vertices(); ++v) {
    const auto begin = graph.targets.begin() + graph.offsets.data()[v];
    const auto end = graph.targets.begin() + graph.offsets.data()[v + 1];
    EXPECT_TRUE(std::is_sorted(begin, end, std::less_equal<>()));
  }
  const auto links = LinksByPair(graph);
  for (const auto& [pair, link] : links) {
    const auto back = links.find({pair.second, pair.first});
    ASSERT_NE(back, links.end());
    EXPECT_EQ(back->second.length, link.length);
    EXPECT_EQ(back->second.kind, link.kind);
    EXPECT_NE(pair.first, pair.second);
    EXPECT_GT(link.length, 0);
  }
}

TEST(BuildSurfaceGraph, GivesEdgesTheirLengthAndCountsThemByEuler) {
  const TriangleMesh mesh = MakeIrregularSphere(8, 2, 6);
  const SurfaceGraph graph = BuildSurfaceGraph(mesh);
  EXPECT_EQ(CountKind(graph, LinkKind::kEdge),
            2 * (mesh.num_vertices() + mesh.num_faces() - 2));
  EXPECT_EQ(graph.num_components, 1);
  const auto links = LinksByPair(graph);
  for (int f = 0; f < mesh.num_faces(); ++f) {
    const int a = mesh.F(f, 0);
    const int b = mesh.F(f, 1);
    EXPECT_EQ(links.at({a, b}).kind, LinkKind::kEdge);
    EXPECT_FLOAT_EQ(
        links.at({a, b}).length,
        static_cast<float>((mesh.vertex(a) - mesh.vertex(b)).norm()));
  }
}

// Two unit right triangles folded along their hypotenuse 1-2.
TriangleMesh FoldedSquare(double fold) {
  TriangleMesh mesh;
  const double h = std::sqrt(0.5);
  mesh.V.resize(4, 3);
  mesh.V << -h, 0, 0, 0, -h, 0, 0, h, 0, h * std::cos(fold), 0,
      h * std::sin(fold);
  mesh.F.resize(2, 3);
  mesh.F << 0, 1, 2, 3, 2, 1;
  return mesh;
}

TEST(BuildSurfaceGraph, UnfoldsTheDiagonalOverAFoldedEdge) {
  for (const double fold : {0.0, 0.7, 1.5, 2.5, 3.1}) {
    SCOPED_TRACE(testing::Message() << "fold " << fold);
    const auto links = LinksByPair(BuildSurfaceGraph(FoldedSquare(fold)));
    ASSERT_TRUE(links.contains({0, 3}));
    EXPECT_EQ(links.at({0, 3}).kind, LinkKind::kDiagonal);
    EXPECT_NEAR(links.at({0, 3}).length, std::sqrt(2), 1e-6);
  }
}

TEST(BuildSurfaceGraph, HasNoDiagonalThatLeavesItsTwoFaces) {
  TriangleMesh mesh = FoldedSquare(0);
  mesh.V.row(0) << -0.2, 3, 0;
  mesh.V.row(3) << 0.2, 3, 0;
  EXPECT_FALSE(LinksByPair(BuildSurfaceGraph(mesh)).contains({0, 3}));
}

TEST(BuildSurfaceGraph, LeavesDiagonalsOutOnRequest) {
  const SurfaceGraph graph =
      BuildSurfaceGraph(MakeIcosphere(3, 1), {.diagonals = false});
  EXPECT_EQ(CountKind(graph, LinkKind::kDiagonal), 0);
  EXPECT_GT(
      CountKind(BuildSurfaceGraph(MakeIcosphere(3, 1)), LinkKind::kDiagonal),
      0);
}

TEST(BuildSurfaceGraph, KeepsAnEdgeThatIsAlsoADiagonal) {
  const TriangleMesh tetrahedron = [] {
    TriangleMesh mesh;
    mesh.V.resize(4, 3);
    mesh.V << 1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1;
    mesh.F.resize(4, 3);
    mesh.F << 0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2;
    return mesh;
  }();
  const SurfaceGraph graph = BuildSurfaceGraph(tetrahedron);
  EXPECT_EQ(CountKind(graph, LinkKind::kEdge), 12);
  EXPECT_EQ(CountKind(graph, LinkKind::kDiagonal), 0);
}

TEST(BuildSurfaceGraph, TakesEmptyAndDegenerateMeshes) {
  EXPECT_EQ(BuildSurfaceGraph(TriangleMesh()).num_vertices(), 0);
  TriangleMesh mesh;
  mesh.V = VertexMatrix::Zero(5, 3);
  mesh.F.resize(2, 3);
  mesh.F << 0, 0, 1, 2, 3, 4;
  const SurfaceGraph graph = BuildSurfaceGraph(mesh);
  EXPECT_EQ(ReachedFrom(graph, 0), 5);
  for (const float length : graph.lengths) EXPECT_GT(length, 0);
}

TEST(BuildSurfaceGraph, NumbersComponentsByTheirFirstVertex) {
  const TriangleMesh a = MakeIcosphere(2, 1);
  const TriangleMesh b = Moved(a, Eigen::Matrix3d::Identity(), 1, {9, 0, 0});
  const SurfaceGraph graph = BuildSurfaceGraph(Join(a, b));
  EXPECT_EQ(graph.num_components, 2);
  EXPECT_EQ(graph.component_of_vertex.front(), 0);
  EXPECT_EQ(graph.component_of_vertex.back(), 1);
}

TEST(BuildSurfaceGraph, JoinsTwoFarSpheresByTheirClosestPair) {
  const TriangleMesh a = MakeIrregularSphere(6, 1, 7);
  const TriangleMesh b =
      Moved(MakeIrregularSphere(5, 1, 8), RandomRotation(8), 1, {5, 1, 2});
  const TriangleMesh mesh = Join(a, b);
  EXPECT_EQ(ReachedFrom(BuildSurfaceGraph(mesh, {.bridges = false}), 0),
            a.num_vertices());
  const SurfaceGraph graph = BuildSurfaceGraph(mesh);
  EXPECT_EQ(ReachedFrom(graph, 0), mesh.num_vertices());
  ASSERT_EQ(CountKind(graph, LinkKind::kBridge), 2);
  double closest = std::numeric_limits<double>::infinity();
  for (int v = 0; v < a.num_vertices(); ++v) {
    for (int w = 0; w < b.num_vertices(); ++w) {
      closest = std::min(closest, (a.vertex(v) - b.vertex(w)).norm());
    }
  }
  const auto bridge =
      std::find(graph.kinds.begin(), graph.kinds.end(), LinkKind::kBridge);
  EXPECT_FLOAT_EQ(graph.lengths.data()[bridge - graph.kinds.begin()],
                  static_cast<float>(closest));
}

TEST(BuildSurfaceGraph, SewsTwoHalvesAlongTheirSeam) {
  const TriangleMesh a = MakeGrid(1, 10, 1);
  const TriangleMesh b = Moved(a, Eigen::Matrix3d::Identity(), 1, {1.02, 0, 0});
  const auto links = LinksByPair(BuildSurfaceGraph(Join(a, b)));
  for (int j = 0; j <= 10; ++j) {
    const std::pair<int, int> seam{10 * 11 + j, a.num_vertices() + j};
    ASSERT_TRUE(links.contains(seam)) << j;
    EXPECT_NEAR(links.at(seam).length, 0.02, 1e-6);
  }
}

// The rule by brute force.
std::set<std::pair<int, int>> BridgesWithin(const TriangleMesh& mesh,
                                            double radius) {
  std::set<std::pair<int, int>> bridges;
  for (int v = 0; v < mesh.num_vertices(); ++v) {
    std::map<int, std::pair<double, int>> nearest;
    for (int w = 0; w < mesh.num_vertices(); ++w) {
      const double d = (mesh.vertex(v) - mesh.vertex(w)).norm();
      if (w / 3 == v / 3 || d > radius) continue;
      const auto [it, inserted] = nearest.try_emplace(w / 3, d, w);
      if (!inserted) it->second = std::min(it->second, std::pair(d, w));
    }
    std::vector<std::pair<double, int>> order;
    for (const auto& [component, entry] : nearest) order.push_back(entry);
    std::sort(order.begin(), order.end());
    order.resize(std::min<size_t>(order.size(), 4));
    for (const auto& [d, w] : order) {
      bridges.emplace(std::min(v, w), std::max(v, w));
    }
  }
  return bridges;
}

TEST(ComputeBridges, JoinsEachSampleToTheNearestOfFourComponents) {
  for (uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const TriangleMesh mesh = TriangleSoup(60, 0.08, seed);
    std::vector<int32_t> component(180);
    for (size_t v = 0; v < 180; ++v) component[v] = static_cast<int32_t>(v / 3);
    std::set<std::pair<int, int>> found;
    for (const Bridge& bridge : ComputeBridges(mesh.V, component, 60, 0.35)) {
      // Longer ones only make the graph connected.
      if (bridge.length <= 0.35) found.emplace(bridge.from, bridge.to);
    }
    EXPECT_EQ(found, BridgesWithin(mesh, 0.35));
  }
}

TEST(ComputeBridges, AreAMinimumSpanningTreeWhenNothingIsNear) {
  for (uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    constexpr int kCount = 50;
    const TriangleMesh mesh = TriangleSoup(kCount, 0.02, seed);
    std::vector<int32_t> component(3 * kCount);
    for (size_t v = 0; v < component.size(); ++v) {
      component[v] = static_cast<int32_t>(v / 3);
    }
    double total = 0;
    const auto bridges = ComputeBridges(mesh.V, component, kCount, 0);
    EXPECT_EQ(bridges.size(), kCount - 1U);
    for (const Bridge& bridge : bridges) total += bridge.length;
    // Prim over the components.
    std::vector<double> best(kCount, std::numeric_limits<double>::infinity());
    std::vector<bool> in_tree(kCount, false);
    best[0] = 0;
    double expected = 0;
    for (size_t round = 0; round < kCount; ++round) {
      size_t next = kCount;
      for (size_t c = 0; c < kCount; ++c) {
        if (!in_tree[c] && (next == kCount || best[c] < best[next])) next = c;
      }
      in_tree[next] = true;
      expected += best[next];
      for (size_t v = 0; v < component.size(); ++v) {
        for (size_t k = 0; k < 3; ++k) {
          const double d = (mesh.vertex(static_cast<int>(v)) -
                            mesh.vertex(static_cast<int>(3 * next + k)))
                               .norm();
          best[v / 3] = std::min(best[v / 3], d);
        }
      }
    }
    EXPECT_NEAR(total, expected, 1e-9);
  }
}

TEST(BuildSurfaceGraph, ConnectsTwoThousandTriangles) {
  const TriangleMesh mesh = TriangleSoup(2000, 0.001, 11);
  const SurfaceGraph graph = BuildSurfaceGraph(mesh);
  EXPECT_EQ(graph.num_components, 2000);
  EXPECT_EQ(ReachedFrom(graph, 17), 6000);
}

TEST(BuildSurfaceGraph, RepeatsBitForBit) {
  const TriangleMesh mesh =
      Join(MakeTorus(1, 0.3, 30, 15), TriangleSoup(100, 0.2, 12));
  const SurfaceGraph a = BuildSurfaceGraph(mesh);
  const SurfaceGraph b = BuildSurfaceGraph(mesh);
  EXPECT_EQ(a.offsets, b.offsets);
  EXPECT_EQ(a.targets, b.targets);
  EXPECT_EQ(a.lengths, b.lengths);
  EXPECT_EQ(a.kinds, b.kinds);
}

}  // namespace
}  // namespace argmesh
