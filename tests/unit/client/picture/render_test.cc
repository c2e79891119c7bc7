#include "client/picture/render.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <vector>

#include "client/picture/corner_normals.h"
#include "client/picture/palette.h"
#include "core/synthesis/mesh_similarity.h"
#include "core/synthesis/pose.h"
#include "core/synthesis/sample_shape.h"
#include "core/synthesis/surface_polygons.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

TriangleMesh MakeSphere() {
  ImplicitSurface surface;
  surface.Add(MakeEllipsoid(At(5, -3, 1), {0.4, 0.4, 0.4}));
  return PolygonizeSurface(surface).value().mesh;
}

TriangleMesh MakeCube() {
  TriangleMesh cube;
  cube.V.resize(8, 3);
  for (int v = 0; v < 8; ++v) cube.V.row(v) << v % 2, v / 2 % 2, v / 4;
  cube.F.resize(12, 3);
  cube.F << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6,
      7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5;
  return cube;
}

// Pixels that differ from the background, by how much of them it covers.
double CoveredPixels(const Image& image) {
  double covered = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      // Black surface on white: the red channel is the share not covered.
      covered += 1 - image.At(x, y)[0] / 255.0;
    }
  }
  return covered;
}

TEST(RenderMesh, ShowsASphereAsADiscOfItsArea) {
  const TriangleMesh sphere = MakeSphere();
  RenderOptions options{.width = 320, .height = 240, .lines = false};
  ASSERT_OK_AND_ASSIGN(const Image image, RenderMesh(sphere, kBlack, options));
  const View view =
      FitView(sphere, options.width, options.height, options.view);
  const double radius = 0.4 * view.pixels_per_unit;
  const double area = std::numbers::pi * radius * radius;
  EXPECT_NEAR(CoveredPixels(image), area, 0.01 * area);
}

TEST(RenderMesh, IsBitEqualForAnyNumberOfThreads) {
  ASSERT_OK_AND_ASSIGN(const SampleShape shape, MakeSampleShape("ant", 1));
  const std::vector<RgbColor> colors = ColorsOfLabels(shape.part_of_face);
  RenderOptions options{.width = 200, .height = 150, .ground_shadow = true};
  options.view.up = Eigen::Vector3d::UnitZ();
  options.markers = {{.position = shape.mesh.vertex(0), .window = 0.1}};
  options.threads = 1;
  ASSERT_OK_AND_ASSIGN(const Image one,
                       RenderMesh(shape.mesh, colors, options));
  for (const int threads : {0, 2, 5, 1}) {
    options.threads = threads;
    ASSERT_OK_AND_ASSIGN(const Image other,
                         RenderMesh(shape.mesh, colors, options));
    EXPECT_EQ(other.bytes(), one.bytes()) << threads << " threads";
  }
}

TEST(RenderMesh, DrawsLinesBetweenColorsOnly) {
  const TriangleMesh cube = MakeCube();
  std::vector<RgbColor> colors(12, {200, 200, 200});
  RenderOptions options{.width = 160, .height = 160, .ambient_rays = 0};
  const auto dark_pixels = [&](bool lines) {
    options.lines = lines;
    const Image image = RenderMesh(cube, colors, options).value();
    int dark = 0;
    for (int y = 0; y < 160; ++y) {
      for (int x = 0; x < 160; ++x) {
        dark += image.At(x, y)[0] < 85 ? 1 : 0;
      }
    }
    return dark;
  };
  const int plain = dark_pixels(true);
  for (size_t f = 0; f < 12; ++f) {
    if (f % 2 == 0) colors[f] = {200, 200, 204};
  }
  EXPECT_GT(dark_pixels(true), plain + 100);
  EXPECT_LE(dark_pixels(false), plain);
}

TEST(RenderMesh, MarksPointsThatAreSeen) {
  const TriangleMesh sphere = MakeSphere();
  RenderOptions options{.width = 160, .height = 160};
  const View view = FitView(sphere, 160, 160, options.view);
  const Eigen::Vector3d center(5, -3, 1);
  options.markers = {{.position = center + 0.4 * view.toward}};
  ASSERT_OK_AND_ASSIGN(const Image seen,
                       RenderMesh(sphere, kPaleGrey, options));
  const RgbColor middle = seen.At(80, 80);
  EXPECT_GT(middle[0], middle[1] + 80);
  options.markers = {{.position = center - 0.4 * view.toward}};
  ASSERT_OK_AND_ASSIGN(const Image hidden,
                       RenderMesh(sphere, kPaleGrey, options));
  EXPECT_NEAR(hidden.At(80, 80)[0], hidden.At(80, 80)[1], 8);
}

TEST(RenderMesh, ShadesSoupLikeTheMeshItCameFrom) {
  const TriangleMesh sphere = MakeSphere();
  const TriangleMesh soup = MakeSoup(sphere);
  RenderOptions options{.width = 100, .height = 100};
  ASSERT_OK_AND_ASSIGN(const Image a, RenderMesh(sphere, kGood, options));
  ASSERT_OK_AND_ASSIGN(const Image b, RenderMesh(soup, kGood, options));
  int differing = 0;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x) {
      differing += std::abs(a.At(x, y)[1] - b.At(x, y)[1]) > 12 ? 1 : 0;
    }
  }
  EXPECT_LT(differing, 20);
}

TEST(RenderMesh, CastsAShadowOnTheGround) {
  RenderOptions options{.width = 120, .height = 120, .lines = false};
  options.view.up = Eigen::Vector3d::UnitZ();
  options.view.margin = 0.25;
  const TriangleMesh sphere = MakeSphere();
  ASSERT_OK_AND_ASSIGN(const Image without,
                       RenderMesh(sphere, kBlack, options));
  options.ground_shadow = true;
  ASSERT_OK_AND_ASSIGN(const Image with, RenderMesh(sphere, kBlack, options));
  EXPECT_GT(CoveredPixels(with), CoveredPixels(without) + 20);
}

TEST(RenderMesh, RefusesWhatItCannotDraw) {
  const TriangleMesh cube = MakeCube();
  const std::vector<RgbColor> few(3, kGood);
  EXPECT_THAT(RenderMesh(cube, few),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       HasSubstr("3 colours for 12 faces")));
  TriangleMesh bad = cube;
  bad.F(5, 1) = 8;
  EXPECT_EQ(RenderMesh(bad, kGood).status().code(),
            absl::StatusCode::kInvalidArgument);
  bad = cube;
  bad.V(2, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(RenderMesh(bad, kGood).status().code(),
            absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(RenderMesh(cube, kGood, {.width = 0}),
              StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("width")));
  EXPECT_THAT(
      RenderMesh(cube, kGood, {.threads = 1000}),
      StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("threads")));
}

TEST(RenderMesh, DrawsDegenerateMeshesWithoutFalling) {
  TriangleMesh flat;  // one point, three times
  flat.V.setZero(3, 3);
  flat.F.resize(1, 3);
  flat.F << 0, 1, 2;
  const RenderOptions options{.width = 32, .height = 32};
  EXPECT_THAT(RenderMesh(flat, kGood, options), IsOk());
  EXPECT_THAT(RenderMesh(TriangleMesh{}, kGood, options), IsOk());
  TriangleMesh sliver = flat;
  sliver.V << 0, 0, 0, 1, 0, 0, 2, 0, 0;
  EXPECT_THAT(RenderMesh(sliver, kGood, options), IsOk());
}

TEST(ComputeCornerNormals, BreakAtCreasesAndRunSmoothElsewhere) {
  const TriangleMesh cube = MakeCube();
  for (const Eigen::Vector3f& n : ComputeCornerNormals(cube)) {
    EXPECT_NEAR(n.cwiseAbs().maxCoeff(), 1, 1e-6);
  }
  const TriangleMesh sphere = MakeSphere();
  const std::vector<Eigen::Vector3f> normals = ComputeCornerNormals(sphere);
  for (int f = 0; f < sphere.num_faces(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d radial =
          (sphere.vertex(sphere.F(f, k)) - Eigen::Vector3d(5, -3, 1))
              .normalized();
      const Eigen::Vector3f& n = normals[static_cast<size_t>(3 * f + k)];
      EXPECT_GT(n.cast<double>().dot(radial), 0.99);
    }
  }
}

}  // namespace
}  // namespace argmesh
