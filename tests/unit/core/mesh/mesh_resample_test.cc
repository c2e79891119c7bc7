#include "core/mesh/mesh_resample.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stop_token>
#include <string>
#include <vector>

#include "absl/time/clock.h"
#include "core/base/random.h"
#include "core/mesh/halfedge_mesh.h"
#include "core/mesh/mesh_edges.h"
#include "core/mesh/mesh_inspect.h"
#include "core/mesh/mesh_repair.h"
#include "core/mesh/mesh_weld.h"
#include "tests/support/status_matchers.h"
#include "tests/support/test_meshes.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

TriangleMesh MakeTetrahedron() {
  TriangleMesh mesh;
  mesh.V.resize(4, 3);
  mesh.V << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  mesh.F.resize(4, 3);
  mesh.F << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3;
  return mesh;
}

// A side of a cylinder as long thin triangles: 2 `segments` faces.
TriangleMesh MakeLongTube(int segments) {
  std::vector<Eigen::Vector2d> profile = {
      {-10, 0.1}, {-10, 1}, {10, 1}, {10, 0.1}};
  return MakeRevolution(profile, segments);
}

TriangleMesh MakeBall(int rings, int segments) {
  std::vector<Eigen::Vector2d> profile;
  for (int i = 0; i <= rings; ++i) {
    const double angle = std::numbers::pi * (rings - i) / rings;
    profile.emplace_back(std::cos(angle), std::sin(angle));
  }
  return MakeRevolution(profile, segments);
}

struct Example {
  std::string name;
  TriangleMesh mesh;
};

std::vector<Example> ClosedExamples() {
  return {{"tetrahedron", MakeTetrahedron()},
          {"coarse torus", MakeTorus(2, 1, 8, 6)},
          {"fine torus", MakeTorus(2, 0.6, 200, 80)},
          {"uneven torus", MakeTorus(2, 0.6, 600, 8)},
          {"ball", MakeBall(80, 120)},
          {"dumbbell", MakeDumbbell(64)},
          {"long tube", MakeLongTube(40)}};
}

TEST(ResampleMesh, MeetsTheBudgetAndKeepsClosedSurfaces) {
  for (const Example& example : ClosedExamples()) {
    for (const int budget : {500, 2000}) {
      SCOPED_TRACE(example.name + " at " + std::to_string(budget));
      ASSERT_OK_AND_ASSIGN(
          const ResampledMesh resampled,
          ResampleMesh(example.mesh, {.vertex_budget = budget}));
      const TriangleMesh& mesh = resampled.mesh;
      EXPECT_LE(mesh.num_vertices(), 1.05 * budget);
      EXPECT_GE(mesh.num_vertices(), 0.95 * budget);
      EXPECT_NEAR(Area(mesh) / Area(example.mesh), 1, 0.02);
      const MeshReport before = InspectMesh(example.mesh);
      const MeshReport after = InspectMesh(mesh, 0);
      EXPECT_EQ(after.euler_characteristic, before.euler_characteristic);
      EXPECT_EQ(after.boundary_edges, 0);
      EXPECT_EQ(after.nonmanifold_vertices, 0);
      EXPECT_EQ(after.unused_vertices, 0);
      EXPECT_EQ(after.degenerate_faces_dropped, 0);
      const double slack = 0.05 * std::sqrt(before.area);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(after.bounding_box_min[axis], before.bounding_box_min[axis],
                    slack);
        EXPECT_NEAR(after.bounding_box_max[axis], before.bounding_box_max[axis],
                    slack);
      }
      EXPECT_THAT(HalfedgeMesh::Create(mesh.F, mesh.num_vertices()).status(),
                  IsOk());
    }
  }
}

TEST(ResampleMesh, SpreadsSamplesEvenly) {
  // Triangles 75 times as long as wide become nearly regular.
  ASSERT_OK_AND_ASSIGN(
      const ResampledMesh resampled,
      ResampleMesh(MakeTorus(2, 0.6, 600, 8), {.vertex_budget = 1000}));
  std::vector<double> areas;
  for (int f = 0; f < resampled.mesh.num_faces(); ++f) {
    areas.push_back(FaceCross(resampled.mesh, f).norm() / 2);
  }
  std::sort(areas.begin(), areas.end());
  const double median = areas[areas.size() / 2];
  EXPECT_GT(areas[areas.size() / 20], 0.3 * median);
  EXPECT_LT(areas[areas.size() * 19 / 20], 2.5 * median);
}

TEST(ResampleMesh, KeepsTheOutlineOfAnOpenSheet) {
  ASSERT_OK_AND_ASSIGN(const ResampledMesh resampled,
                       ResampleMesh(MakeSheet(60), {.vertex_budget = 600}));
  EXPECT_NEAR(Area(resampled.mesh), 1, 0.01);
  const MeshReport report = InspectMesh(resampled.mesh, 0);
  EXPECT_EQ(report.euler_characteristic, 1);
  EXPECT_EQ(report.components, 1);
  EXPECT_NEAR(report.bounding_box_max[0], 1, 0.01);
  EXPECT_NEAR(resampled.mesh.num_vertices(), 600, 30);
}

TEST(ResampleMesh, LetsNoComponentVanish) {
  TriangleMesh mesh = MakeDumbbell(48);
  for (int i = 0; i < 30; ++i) {
    TriangleMesh ball = MakeBall(8, 10);
    ball.V *= 1e-3;
    mesh = Join(mesh, Translated(ball, {3 + 0.01 * i, 0, 0}));
  }
  ASSERT_OK_AND_ASSIGN(const ResampledMesh resampled,
                       ResampleMesh(mesh, {.vertex_budget = 1000}));
  const MeshReport report = InspectMesh(resampled.mesh, 0);
  EXPECT_EQ(report.components, 31);
  EXPECT_EQ(report.euler_characteristic, 62);
  EXPECT_NEAR(resampled.mesh.num_vertices(), 1000, 50);
}

TEST(ResampleMesh, ReturnsWhatIsLeftWhenComponentsAreTooMany) {
  TriangleMesh mesh;
  constexpr int kTriangles = 500;
  mesh.V.resize(3 * kTriangles, 3);
  mesh.F.resize(kTriangles, 3);
  Random random(5);
  for (int f = 0; f < kTriangles; ++f) {
    for (int c = 0; c < 3; ++c) {
      mesh.V.row(3 * f + c) << random.Uniform(), random.Uniform(),
          random.Uniform();
      mesh.F(f, c) = 3 * f + c;
    }
  }
  ASSERT_OK_AND_ASSIGN(const ResampledMesh resampled,
                       ResampleMesh(mesh, {.vertex_budget = 100}));
  EXPECT_EQ(InspectMesh(resampled.mesh, 0).components, kTriangles);
  EXPECT_LE(resampled.mesh.num_vertices(), 3 * kTriangles);
}

TEST(ResampleMesh, BoundsTheGrowthWhereOneTriangleIsHuge) {
  TriangleMesh mesh = MakeBall(60, 80);
  mesh.V *= 1e-6;
  mesh = Join(mesh, MakeTetrahedron());
  mesh = Join(mesh, Translated(MakeLongTube(20), {0, 0, 1e4}));
  mesh.V.bottomRows(1) << 0, 0, 1e7;  // a needle
  ASSERT_OK_AND_ASSIGN(const ResampledMesh resampled,
                       ResampleMesh(mesh, {.vertex_budget = 300}));
  EXPECT_LE(resampled.mesh.num_vertices(), 1.05 * 300);
  // Counted here: to an inspection the ball is too small to have an area.
  const MeshEdges edges =
      ComputeMeshEdges(resampled.mesh.F, resampled.mesh.num_vertices());
  EXPECT_EQ(resampled.mesh.num_vertices() - static_cast<int>(edges.size()) +
                resampled.mesh.num_faces(),
            6);
}

TEST(ResampleMesh, GivesBitEqualResultsForEqualInput) {
  const TriangleMesh mesh = MakeDumbbell(40);
  ASSERT_OK_AND_ASSIGN(const ResampledMesh a, ResampleMesh(mesh));
  ASSERT_OK_AND_ASSIGN(const ResampledMesh b, ResampleMesh(mesh));
  EXPECT_EQ(a.mesh.V, b.mesh.V);
  EXPECT_EQ(a.mesh.F, b.mesh.F);
  EXPECT_EQ(a.sample_of_face, b.sample_of_face);
}

TEST(ResampleMesh, MapsFacesToSamplesNearby) {
  const TriangleMesh mesh = MakeTorus(2, 0.6, 100, 40);
  ASSERT_OK_AND_ASSIGN(const ResampledMesh resampled,
                       ResampleMesh(mesh, {.vertex_budget = 1000}));
  ASSERT_EQ(resampled.sample_of_face.size(),
            static_cast<size_t>(mesh.num_faces()));
  const double edge = std::sqrt(Area(mesh) / 1000);
  for (int f = 0; f < mesh.num_faces(); ++f) {
    const Eigen::Vector3d centroid =
        (mesh.vertex(mesh.F(f, 0)) + mesh.vertex(mesh.F(f, 1)) +
         mesh.vertex(mesh.F(f, 2))) /
        3;
    const int sample = resampled.sample_of_face[static_cast<size_t>(f)];
    EXPECT_LT((resampled.mesh.vertex(sample) - centroid).norm(), 1.5 * edge);
  }
}

TEST(ResampleMesh, MapsBothSidesOfAThinPlateToTheirOwn) {
  TriangleMesh top = Translated(MakeSheet(30), {0, 0, 1e-3});
  TriangleMesh bottom = MakeSheet(30);
  for (int f = 0; f < bottom.num_faces(); ++f) {
    std::swap(bottom.F(f, 1), bottom.F(f, 2));
  }
  const TriangleMesh plate = Join(top, bottom);
  ASSERT_OK_AND_ASSIGN(const ResampledMesh resampled,
                       ResampleMesh(plate, {.vertex_budget = 500}));
  for (int f = 0; f < plate.num_faces(); ++f) {
    const int sample = resampled.sample_of_face[static_cast<size_t>(f)];
    EXPECT_EQ(resampled.mesh.V(sample, 2) > 5e-4, f < top.num_faces()) << f;
  }
}

TEST(ResampleMesh, KeepsItsDigitsFarFromTheOrigin) {
  const TriangleMesh mesh = Translated(MakeTorus(2, 0.6, 60, 30), {1e6, 0, 0});
  ASSERT_OK_AND_ASSIGN(const ResampledMesh resampled,
                       ResampleMesh(mesh, {.vertex_budget = 1000}));
  EXPECT_NEAR(Area(resampled.mesh) / Area(mesh), 1, 0.02);
  EXPECT_NEAR(InspectMesh(resampled.mesh, 0).bounding_box_max[0], 1e6 + 2.6,
              0.02);
}

TEST(ResampleMesh, StopsWhenAsked) {
  std::stop_source source;
  source.request_stop();
  const StopToken cancelled(source.get_token(), absl::InfiniteFuture());
  EXPECT_THAT(ResampleMesh(MakeDumbbell(), {}, cancelled),
              StatusIs(absl::StatusCode::kCancelled, testing::_));
  const StopToken late({}, absl::Now() - absl::Seconds(1));
  EXPECT_THAT(ResampleMesh(MakeDumbbell(), {}, late),
              StatusIs(absl::StatusCode::kDeadlineExceeded, testing::_));
}

TEST(ResampleMesh, RefusesBadInputAndOptions) {
  for (const int budget : {-1, 0, 99, 100'001}) {
    EXPECT_THAT(ResampleMesh(MakeSheet(2), {.vertex_budget = budget}),
                StatusIs(absl::StatusCode::kInvalidArgument,
                         HasSubstr("vertex_budget")));
  }
  for (const double weight : {-1.0, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THAT(ResampleMesh(MakeSheet(2), {.quadric_weight = weight}),
                StatusIs(absl::StatusCode::kInvalidArgument,
                         HasSubstr("quadric_weight")));
  }
  TriangleMesh flat = MakeSheet(2);
  flat.V.setZero();
  for (const TriangleMesh& mesh : {flat, TriangleMesh{}}) {
    EXPECT_THAT(ResampleMesh(mesh),
                StatusIs(absl::StatusCode::kFailedPrecondition, testing::_));
  }
  TriangleMesh unoriented = MakeSheet(2);
  std::swap(unoriented.F(3, 0), unoriented.F(3, 1));
  EXPECT_THAT(ResampleMesh(unoriented),
              StatusIs(absl::StatusCode::kFailedPrecondition,
                       HasSubstr("non-manifold")));
}

TEST(ResampleMesh, HoldsOnRepairedRandomSoups) {
  for (uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    TriangleMesh soup;
    soup.V.resize(20, 3);
    for (int v = 0; v < 20; ++v) {
      soup.V.row(v) << random.Normal(), random.Normal(), random.Normal();
    }
    soup.F.resize(60, 3);
    for (int f = 0; f < 60; ++f) {
      for (int c = 0; c < 3; ++c) {
        soup.F(f, c) = static_cast<int>(random.Below(20));
      }
    }
    ASSERT_OK_AND_ASSIGN(const RepairedMesh repaired, RepairMesh(soup));
    ASSERT_OK_AND_ASSIGN(const ResampledMesh resampled,
                         ResampleMesh(repaired.mesh, {.vertex_budget = 400}));
    const TriangleMesh& mesh = resampled.mesh;
    EXPECT_THAT(HalfedgeMesh::Create(mesh.F, mesh.num_vertices()).status(),
                IsOk());
    EXPECT_NEAR(mesh.num_vertices(), 400, 40);
    EXPECT_NEAR(Area(mesh) / Area(repaired.mesh), 1, 0.15);
  }
}

}  // namespace
}  // namespace argmesh
