#include "core/mesh/mesh_repair.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "core/base/random.h"
#include "core/mesh/halfedge_mesh.h"
#include "core/mesh/mesh_edges.h"
#include "core/mesh/mesh_weld.h"
#include "tests/support/status_matchers.h"
#include "tests/support/test_meshes.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

TriangleMesh MakeCube() {
  TriangleMesh cube;
  cube.V.resize(8, 3);
  for (int v = 0; v < 8; ++v) cube.V.row(v) << v % 2, v / 2 % 2, v / 4;
  cube.F.resize(12, 3);
  cube.F << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6,
      7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5;
  return cube;
}

// Every face gets three vertices of its own.
TriangleMesh Soup(const TriangleMesh& mesh) {
  TriangleMesh soup;
  soup.V.resize(3 * mesh.num_faces(), 3);
  soup.F.resize(mesh.num_faces(), 3);
  for (int f = 0; f < mesh.num_faces(); ++f) {
    for (int c = 0; c < 3; ++c) {
      soup.V.row(3 * f + c) = mesh.V.row(mesh.F(f, c));
      soup.F(f, c) = 3 * f + c;
    }
  }
  return soup;
}

void Flip(TriangleMesh& mesh, int f) { std::swap(mesh.F(f, 1), mesh.F(f, 2)); }

double SignedVolume(const TriangleMesh& mesh) {
  double volume = 0;
  for (int f = 0; f < mesh.num_faces(); ++f) {
    volume += mesh.vertex(mesh.F(f, 0)).dot(FaceCross(mesh, f)) / 6;
  }
  return volume;
}

// A band of `segments` quads around a circle with half a twist.
TriangleMesh MakeMoebiusStrip(int segments) {
  TriangleMesh strip;
  strip.V.resize(2 * segments, 3);
  strip.F.resize(2 * segments, 3);
  for (int s = 0; s < segments; ++s) {
    const double angle = 2 * std::numbers::pi * s / segments;
    for (int side = 0; side < 2; ++side) {
      const double w = side == 0 ? -0.3 : 0.3;
      const double r = 1 + w * std::cos(angle / 2);
      strip.V.row(2 * s + side) << r * std::cos(angle), r * std::sin(angle),
          w * std::sin(angle / 2);
    }
    const bool last = s + 1 == segments;
    const int next0 = last ? 1 : 2 * s + 2;
    const int next1 = last ? 0 : 2 * s + 3;
    strip.F.row(2 * s) << 2 * s, next0, 2 * s + 1;
    strip.F.row(2 * s + 1) << 2 * s + 1, next0, next1;
  }
  return strip;
}

void ExpectManifold(const TriangleMesh& mesh) {
  EXPECT_THAT(HalfedgeMesh::Create(mesh.F, mesh.num_vertices()).status(),
              IsOk());
}

TEST(RepairMesh, LeavesACleanMeshAsItIs) {
  const TriangleMesh cube = MakeCube();
  ASSERT_GT(SignedVolume(cube), 0);
  ASSERT_OK_AND_ASSIGN(const RepairedMesh repaired, RepairMesh(cube));
  EXPECT_EQ(repaired.mesh.V, cube.V);
  EXPECT_EQ(repaired.mesh.F, cube.F);
  EXPECT_EQ(repaired.report.vertices, 8);
  EXPECT_EQ(repaired.report.faces, 12);
  EXPECT_EQ(repaired.report.components, 1);
  EXPECT_EQ(repaired.report.boundary_edges, 0);
  EXPECT_EQ(repaired.report.welded_vertices, 0);
  EXPECT_EQ(repaired.report.faces_flipped, 0);
  EXPECT_EQ(repaired.report.vertices_split, 0);
  EXPECT_EQ(repaired.report.euler_characteristic, 2);
  EXPECT_DOUBLE_EQ(repaired.report.area, 6);
}

TEST(RepairMesh, WeldsASoupBackTogether) {
  const TriangleMesh torus = MakeTorus(2, 1, 24, 15);
  ASSERT_OK_AND_ASSIGN(const RepairedMesh repaired, RepairMesh(Soup(torus)));
  EXPECT_EQ(repaired.mesh.num_vertices(), torus.num_vertices());
  EXPECT_EQ(repaired.report.welded_vertices,
            3 * torus.num_faces() - torus.num_vertices());
  EXPECT_EQ(repaired.report.euler_characteristic, 0);
  EXPECT_EQ(repaired.report.boundary_edges, 0);
}

TEST(RepairMesh, WeldsWithinTheDistanceAndNotBeyond) {
  TriangleMesh soup = Soup(MakeCube());
  for (int v = 0; v < soup.num_vertices(); ++v) {
    soup.V(v, v % 3) += (v % 2 == 0 ? 1 : -1) * 1e-3;  // at most 2e-3 apart
  }
  ASSERT_OK_AND_ASSIGN(const RepairedMesh near,
                       RepairMesh(soup, {.weld_distance = 2e-3}));  // 4.9e-3
  EXPECT_EQ(near.mesh.num_vertices(), 8);
  ASSERT_OK_AND_ASSIGN(const RepairedMesh far,
                       RepairMesh(soup, {.weld_distance = 1e-4}));
  EXPECT_GT(far.mesh.num_vertices(), 8);
}

TEST(RepairMesh, DoesNotWeldChainsOfCloseVerticesIntoOne) {
  // The next vertex is within the distance, the one after is not: every second
  // one is kept.
  constexpr int kCount = 101;
  constexpr double kStep = 0.006;
  TriangleMesh strip;
  strip.V.resize(2 * kCount, 3);
  strip.F.resize(2 * (kCount - 1), 3);
  for (int i = 0; i < kCount; ++i) {
    strip.V.row(2 * i) << kStep * i, 0, 0;
    strip.V.row(2 * i + 1) << kStep * i, 1, 0;
  }
  for (int i = 0; i + 1 < kCount; ++i) {
    strip.F.row(2 * i) << 2 * i, 2 * i + 2, 2 * i + 1;
    strip.F.row(2 * i + 1) << 2 * i + 1, 2 * i + 2, 2 * i + 3;
  }
  const double area = kStep * (kCount - 1);
  ASSERT_OK_AND_ASSIGN(
      const RepairedMesh repaired,
      RepairMesh(strip, {.weld_distance = 1.25 * kStep / std::sqrt(area)}));
  EXPECT_EQ(repaired.mesh.num_vertices(), kCount + 1);
}

TEST(RepairMesh, WeldsEqualPositionsOfBothZeros) {
  TriangleMesh soup = Soup(MakeCube());
  for (int v = 0; v < soup.num_vertices(); v += 2) {
    for (int axis = 0; axis < 3; ++axis) {
      if (soup.V(v, axis) == 0) soup.V(v, axis) = -0.0;
    }
  }
  ASSERT_OK_AND_ASSIGN(const RepairedMesh repaired,
                       RepairMesh(soup, {.weld_distance = 0}));
  EXPECT_EQ(repaired.mesh.num_vertices(), 8);
}

TEST(RepairMesh, CountsWhatItDrops) {
  TriangleMesh cube = MakeCube();
  cube.V.conservativeResize(10, 3);
  cube.V.row(8) << 0.5, 0, 0;  // on an edge
  cube.V.row(9) << 7, 7, 7;    // unused
  cube.F.conservativeResize(16, 3);
  cube.F.row(12) << 0, 0, 1;  // a vertex twice
  cube.F.row(13) << 0, 8, 1;  // no area
  cube.F.row(14) = cube.F.row(3);
  cube.F.row(15) << cube.F(5, 1), cube.F(5, 0), cube.F(5, 2);
  ASSERT_OK_AND_ASSIGN(const RepairedMesh repaired, RepairMesh(cube));
  EXPECT_EQ(repaired.report.degenerate_faces_dropped, 2);
  EXPECT_EQ(repaired.report.duplicate_faces_dropped, 2);
  EXPECT_EQ(repaired.report.unused_vertices, 1);
  EXPECT_EQ(repaired.mesh.F, MakeCube().F);
  for (int f = 0; f < 12; ++f) {
    EXPECT_EQ(repaired.source_face[Slot(f)], f);
  }
  EXPECT_EQ(repaired.report.bounding_box_max[0], 1);
}

TEST(RepairMesh, OrientsClosedComponentsOutwards) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    TriangleMesh torus = MakeTorus(2, 0.7, 16, 9);
    int flipped = 0;
    for (int f = 0; f < torus.num_faces(); ++f) {
      if (random.Uniform() < 0.6) {
        Flip(torus, f);
        ++flipped;
      }
    }
    ASSERT_OK_AND_ASSIGN(const RepairedMesh repaired, RepairMesh(torus));
    EXPECT_GT(SignedVolume(repaired.mesh), 0);
    EXPECT_EQ(repaired.report.faces_flipped, flipped);
    ExpectManifold(repaired.mesh);
  }
}

TEST(RepairMesh, KeepsTheOrientationOfMostOfAnOpenSurface) {
  TriangleMesh sheet = MakeSheet(10);
  for (int f = 0; f < 60; ++f) Flip(sheet, f);  // of 200 equal faces
  ASSERT_OK_AND_ASSIGN(const RepairedMesh few, RepairMesh(sheet));
  EXPECT_EQ(few.mesh.F, MakeSheet(10).F);
  EXPECT_EQ(few.report.faces_flipped, 60);
  for (int f = 60; f < 140; ++f) Flip(sheet, f);
  ASSERT_OK_AND_ASSIGN(const RepairedMesh most, RepairMesh(sheet));
  EXPECT_EQ(most.report.faces_flipped, 60);
  EXPECT_LT(FaceCross(most.mesh, 0).z(), 0);
}

TEST(RepairMesh, PartsTwoCubesThatShareAnEdge) {
  const TriangleMesh pair = Join(MakeCube(), Translated(MakeCube(), {1, 1, 0}));
  ASSERT_OK_AND_ASSIGN(const RepairedMesh repaired, RepairMesh(pair));
  EXPECT_EQ(repaired.report.welded_vertices, 2);
  EXPECT_EQ(repaired.report.nonmanifold_edges, 1);
  EXPECT_EQ(repaired.report.nonmanifold_vertices, 2);
  EXPECT_EQ(repaired.report.components, 1);
  EXPECT_EQ(repaired.report.vertices_split, 2);
  EXPECT_EQ(repaired.report.euler_characteristic, 4);
  EXPECT_DOUBLE_EQ(SignedVolume(repaired.mesh), 2);
  ExpectManifold(repaired.mesh);
}

TEST(RepairMesh, PartsTwoCubesThatShareAVertex) {
  const TriangleMesh pair = Join(MakeCube(), Translated(MakeCube(), {1, 1, 1}));
  ASSERT_OK_AND_ASSIGN(const RepairedMesh repaired, RepairMesh(pair));
  EXPECT_EQ(repaired.report.nonmanifold_edges, 0);
  EXPECT_EQ(repaired.report.nonmanifold_vertices, 1);
  EXPECT_EQ(repaired.report.vertices_split, 1);
  EXPECT_EQ(repaired.report.euler_characteristic, 4);
  ExpectManifold(repaired.mesh);
}

TEST(RepairMesh, CutsAMoebiusStripOpen) {
  const TriangleMesh strip = MakeMoebiusStrip(12);
  ASSERT_OK_AND_ASSIGN(const RepairedMesh repaired, RepairMesh(strip));
  EXPECT_EQ(repaired.report.unorientable_components, 1);
  EXPECT_EQ(repaired.report.vertices_split, 2);
  EXPECT_EQ(repaired.report.euler_characteristic, 1);  // a disk now
  EXPECT_EQ(repaired.mesh.num_faces(), strip.num_faces());
  ExpectManifold(repaired.mesh);
}

TEST(RepairMesh, CutsAKleinBottleOpen) {
  // A grid whose top row meets the bottom row turned around.
  constexpr int kSize = 8;
  TriangleMesh bottle;
  bottle.V.resize(kSize * kSize, 3);
  bottle.F.resize(2 * kSize * kSize, 3);
  Random random(3);
  for (int v = 0; v < kSize * kSize; ++v) {
    bottle.V.row(v) << random.Uniform(), random.Uniform(), random.Uniform();
  }
  const auto at = [](int i, int j) {
    if (j == kSize) return (kSize - i) % kSize;
    return j * kSize + i % kSize;
  };
  int f = 0;
  for (int j = 0; j < kSize; ++j) {
    for (int i = 0; i < kSize; ++i) {
      bottle.F.row(f++) << at(i, j), at(i + 1, j), at(i, j + 1);
      bottle.F.row(f++) << at(i + 1, j), at(i + 1, j + 1), at(i, j + 1);
    }
  }
  ASSERT_OK_AND_ASSIGN(const RepairedMesh repaired, RepairMesh(bottle));
  EXPECT_EQ(repaired.report.boundary_edges, 0);
  EXPECT_EQ(repaired.report.unorientable_components, 1);
  EXPECT_GT(repaired.report.vertices_split, 0);
  ExpectManifold(repaired.mesh);
}

TEST(RepairMesh, MakesAManifoldOfAnyRandomSoup) {
  for (uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    TriangleMesh soup;
    const auto vertices = static_cast<int>(4 + random.Below(30));
    const auto faces = static_cast<int>(2 + random.Below(150));
    soup.V.resize(vertices, 3);
    for (int v = 0; v < vertices; ++v) {
      // On a coarse grid, so that positions repeat and faces degenerate.
      for (int axis = 0; axis < 3; ++axis) {
        soup.V(v, axis) = static_cast<double>(random.Below(4));
      }
    }
    soup.F.resize(faces, 3);
    for (int f = 0; f < faces; ++f) {
      for (int c = 0; c < 3; ++c) {
        soup.F(f, c) =
            static_cast<int>(random.Below(static_cast<uint64_t>(vertices)));
      }
    }
    const auto repaired = RepairMesh(soup);
    if (!repaired.ok()) {
      EXPECT_THAT(repaired,
                  StatusIs(absl::StatusCode::kFailedPrecondition, testing::_));
      continue;
    }
    const TriangleMesh& mesh = repaired->mesh;
    const MeshReport& report = repaired->report;
    ExpectManifold(mesh);
    EXPECT_EQ(mesh.num_faces() + report.degenerate_faces_dropped +
                  report.duplicate_faces_dropped,
              report.faces);
    const MeshEdges edges = ComputeMeshEdges(mesh.F, mesh.num_vertices());
    EXPECT_EQ(report.euler_characteristic, mesh.num_vertices() -
                                               static_cast<int>(edges.size()) +
                                               mesh.num_faces());
    for (int f = 0; f < mesh.num_faces(); ++f) {
      const int source = repaired->source_face[Slot(f)];
      const double cosine = FaceCross(mesh, f).normalized().dot(
          FaceCross(soup, source).normalized());
      EXPECT_NEAR(std::abs(cosine), 1, 1e-9);
    }
    ASSERT_OK_AND_ASSIGN(const RepairedMesh again, RepairMesh(mesh, {0}));
    EXPECT_EQ(again.mesh.num_faces(), mesh.num_faces());
  }
}

TEST(RepairMesh, GivesBitEqualResultsForEqualInput) {
  const TriangleMesh soup = Soup(MakeDumbbell(24));
  ASSERT_OK_AND_ASSIGN(const RepairedMesh a, RepairMesh(soup));
  ASSERT_OK_AND_ASSIGN(const RepairedMesh b, RepairMesh(soup));
  EXPECT_EQ(a.mesh.V, b.mesh.V);
  EXPECT_EQ(a.mesh.F, b.mesh.F);
}

TEST(RepairMesh, RefusesWhatHasNoArea) {
  TriangleMesh line = MakeSheet(2);
  line.V.col(1).setZero();
  EXPECT_THAT(RepairMesh(line),
              StatusIs(absl::StatusCode::kFailedPrecondition,
                       HasSubstr("none of 8 faces has a positive area")));
  EXPECT_THAT(RepairMesh(TriangleMesh{}),
              StatusIs(absl::StatusCode::kFailedPrecondition, testing::_));
  TriangleMesh huge = MakeSheet(2);
  huge.V *= 1e200;
  EXPECT_THAT(RepairMesh(huge),
              StatusIs(absl::StatusCode::kFailedPrecondition, testing::_));
}

TEST(RepairMesh, RefusesBadInputAndOptions) {
  TriangleMesh cube = MakeCube();
  cube.F(3, 1) = 8;
  EXPECT_THAT(RepairMesh(cube), StatusIs(absl::StatusCode::kInvalidArgument,
                                         HasSubstr("face 3: vertex 8 of 8")));
  for (const double distance :
       {-1e-9, 0.011, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THAT(RepairMesh(MakeCube(), {.weld_distance = distance}),
                StatusIs(absl::StatusCode::kInvalidArgument,
                         HasSubstr("weld_distance")));
  }
}

}  // namespace
}  // namespace argmesh
