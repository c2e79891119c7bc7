#include "core/synthesis/primitive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/synthesis/implicit_surface.h"
#include "core/synthesis/pose.h"
#include "core/synthesis/sweep.h"

namespace argmesh {
namespace {

using Eigen::Vector3d;

TEST(Primitive, HasTheDistancesOfElementaryGeometry) {
  const Pose here = Pose::Identity();
  const struct {
    const char* name;
    Primitive primitive;
    Vector3d point;
    double distance;
  } cases[] = {
      {"capsule side", MakeCapsule({0, 0, 0}, {4, 0, 0}, 1, 1), {2, 3, 0}, 2},
      {"capsule end", MakeCapsule({0, 0, 0}, {4, 0, 0}, 1, 1), {7, 0, 0}, 2},
      {"swallowed end", MakeCapsule({0, 0, 0}, {1, 0, 0}, 3, 1), {5, 0, 0}, 2},
      {"box face", MakeBox(here, {1, 2, 3}, 0), {4, 0, 0}, 3},
      {"box corner", MakeBox(here, {1, 2, 3}, 0), {4, 6, 3}, 5},
      {"box inside", MakeBox(here, {1, 2, 3}, 0), {0, 0, 0}, -1},
      {"rounded box", MakeBox(here, {1, 2, 3}, 0.5), {4, 0, 0}, 2.5},
      {"torus", MakeTorus(here, 3, 1), {0, 0, 0}, 2},
      {"moved torus", MakeTorus(At(0, 0, 5), 3, 1), {3, 0, 5}, -1},
      {"sphere", MakeEllipsoid(here, {2, 2, 2}), {5, 0, 0}, 3},
      {"ellipsoid surface", MakeEllipsoid(here, {1, 2, 3}), {0, 2, 0}, 0},
      {"cylinder wall",
       MakeLathe(here, RectangleOutline({0, -1}, {2, 1}), 0),
       {3, 4, 0},
       3},
      {"cylinder axis has no surface",
       MakeLathe(here, RectangleOutline({0, -5}, {2, 5}), 0),
       {0, 0, 0},
       -2},
      {"shell", MakeShell(here, {{2, -1}, {2, 1}}, 0.5), {0, 0, 0}, 1.75},
      {"extrusion above",
       MakeExtrusion(here, RectangleOutline({-1, -1}, {1, 1}), 2, 0),
       {0, 0, 5},
       3},
      {"turned extrusion",
       MakeExtrusion(TurnX(90), RectangleOutline({-1, -1}, {1, 1}), 2, 0),
       {0, 5, 0},
       3},
  };
  for (const auto& c : cases) {
    EXPECT_NEAR(c.primitive.Distance(c.point), c.distance, 1e-12) << c.name;
  }
}

TEST(Primitive, OfRoundConesIsTheEnvelopeOfItsSpheres) {
  const Primitive cone = MakeCapsule({0, 0, 0}, {0, 0, 2}, 0.8, 0.2);
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const Vector3d p(random.Uniform(-2, 2), random.Uniform(-2, 2),
                     random.Uniform(-2, 4));
    double nearest = 1e9;
    for (int j = 0; j <= 4000; ++j) {
      const double t = j / 4000.0;
      nearest = std::min(nearest,
                         (p - Vector3d(0, 0, 2 * t)).norm() - (0.8 - 0.6 * t));
    }
    EXPECT_NEAR(cone.Distance(p), nearest, 1e-4) << "point " << i;
  }
}

TEST(Primitive, StaysInsideItsBounds) {
  Random random(11);
  const std::vector<Primitive> primitives = {
      MakeCapsule({0.2, 0, 0}, {0.5, 1, -1}, 0.4, 0.1),
      MakeEllipsoid(At(0, 1, 0) * TurnX(30), {0.3, 1, 0.5}),
      MakeBox(TurnZ(45), {1, 0.2, 0.1}, 0.1),
      MakeTorus(TurnY(60), 1, 0.3),
      MakeLathe(TurnX(20), {{0, 0}, {1, 0}, {0.5, 1}, {0, 1}}, 0.05),
      MakeShell(TurnX(70), {{0.5, 0}, {1, 1}}, 0.2),
      MakeExtrusion(TurnY(10), {{0, 0}, {1, 0}, {0, 1}}, 0.3, 0.1)};
  for (size_t i = 0; i < primitives.size(); ++i) {
    const Eigen::AlignedBox3d box = primitives[i].Bounds();
    for (int j = 0; j < 2000; ++j) {
      const Vector3d p(random.Uniform(-3, 3), random.Uniform(-3, 3),
                       random.Uniform(-3, 3));
      if (primitives[i].Distance(p) >= 0) continue;
      EXPECT_LE(box.squaredExteriorDistance(p), 1e-18) << "primitive " << i;
    }
  }
}

TEST(ImplicitSurface, CullsNothingThatShapesTheSurfaceNearby) {
  ImplicitSurface surface;
  Random random(3);
  for (int i = 0; i < 30; ++i) {
    surface.BeginPart("part" + std::to_string(i % 4));
    const Vector3d a(random.Uniform(-1, 1), random.Uniform(-1, 1),
                     random.Uniform(-1, 1));
    surface.Add(MakeCapsule(a, 1.2 * a, 0.1, 0.05), 0.05);
  }
  surface.Cut(MakeBox(At(0.5, 0, 0), {0.2, 0.2, 0.2}, 0.02), 0.03);
  const std::vector<int32_t> all = surface.AllTerms();
  EXPECT_EQ(surface.part_names().size(), 4U);
  for (int i = 0; i < 200; ++i) {
    const Vector3d center(random.Uniform(-1, 1), random.Uniform(-1, 1),
                          random.Uniform(-1, 1));
    double distance = 0;
    const std::vector<int32_t> near =
        surface.TermsNear(center, 0.1, all, &distance);
    if (std::abs(distance) > 0.1) continue;
    for (int j = 0; j < 20; ++j) {
      const Vector3d p =
          center + 0.05 * Vector3d(random.Uniform(-1, 1), random.Uniform(-1, 1),
                                   random.Uniform(-1, 1));
      EXPECT_NEAR(surface.Distance(p, near), surface.Distance(p, all), 1e-12);
    }
  }
}

TEST(ImplicitSurface, UnitesATubeWithoutSwellingItsJoints) {
  ImplicitSurface surface;
  std::vector<SweepKnot> knots;
  for (int i = 0; i < 5; ++i) knots.push_back({{0.3 * i, 0, 0}, 0.1});
  AddSweep(surface, knots, {.blend = 0.1, .pieces = 4});
  const std::vector<int32_t> all = surface.AllTerms();
  for (double x = 0; x <= 1.2; x += 0.05) {
    EXPECT_NEAR(surface.Distance({x, 0.1, 0}, all), 0, 1e-12) << x;
  }
}

}  // namespace
}  // namespace argmesh
