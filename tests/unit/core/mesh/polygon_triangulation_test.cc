#include "core/mesh/polygon_triangulation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "core/base/random.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr int64_t kManyTests = 1'000'000'000;

struct Polygon {
  std::vector<double> coordinates;
  std::vector<int32_t> corners;
};

// In the plane that `rotation` turns z = 2 into.
Polygon MakePolygon(const std::vector<Eigen::Vector2d>& points,
                    const Eigen::Matrix3d& rotation) {
  Polygon polygon;
  for (const Eigen::Vector2d& p : points) {
    const Eigen::Vector3d q = rotation * Eigen::Vector3d(p.x(), p.y(), 2);
    polygon.coordinates.insert(polygon.coordinates.end(),
                               {q.x(), q.y(), q.z()});
  }
  polygon.corners.resize(points.size());
  std::iota(polygon.corners.begin(), polygon.corners.end(), 0);
  return polygon;
}

std::vector<int32_t> Triangulate(const Polygon& polygon) {
  PolygonTriangulator triangulator(polygon.coordinates, kManyTests);
  std::vector<int32_t> triangles(3 * (polygon.corners.size() - 2), -1);
  EXPECT_THAT(triangulator.Triangulate(polygon.corners, triangles), IsOk());
  EXPECT_EQ(triangulator.num_irregular(), 0);
  return triangles;
}

double SignedArea(const std::vector<Eigen::Vector2d>& points) {
  double twice = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d& p = points[i];
    const Eigen::Vector2d& q = points[(i + 1) % points.size()];
    twice += p.x() * q.y() - p.y() * q.x();
  }
  return twice / 2;
}

// Every triangle has the polygon's sense and their areas sum to its area: so
// they neither overlap nor leave anything out.
void ExpectTiles(const std::vector<Eigen::Vector2d>& points,
                 const std::vector<int32_t>& triangles) {
  double sum = 0;
  for (size_t t = 0; t + 2 < triangles.size(); t += 3) {
    const double area =
        SignedArea({points[static_cast<size_t>(triangles[t])],
                    points[static_cast<size_t>(triangles[t + 1])],
                    points[static_cast<size_t>(triangles[t + 2])]});
    EXPECT_GT(area, 0) << "triangle " << t / 3;
    sum += area;
  }
  const double area = SignedArea(points);
  EXPECT_NEAR(sum, area, 1e-9 * area);
}

const Eigen::Matrix3d kUpright = Eigen::Matrix3d::Identity();

TEST(PolygonTriangulator, MakesAFanOfAConvexPolygon) {
  const Polygon polygon =
      MakePolygon({{0, 0}, {2, 0}, {3, 1}, {2, 2}, {0, 2}}, kUpright);
  EXPECT_THAT(Triangulate(polygon), ElementsAre(0, 1, 2, 0, 2, 3, 0, 3, 4));
}

TEST(PolygonTriangulator, CutsAnArrowheadAtItsReflexCorner) {
  // A fan around the first corner would cover the notch.
  const std::vector<Eigen::Vector2d> arrow = {{0, 0}, {2, -1}, {1, 0}, {2, 1}};
  for (size_t first = 0; first < arrow.size(); ++first) {
    std::vector<Eigen::Vector2d> turned = arrow;
    std::rotate(turned.begin(), turned.begin() + static_cast<long>(first),
                turned.end());
    ExpectTiles(turned, Triangulate(MakePolygon(turned, kUpright)));
  }
}

TEST(PolygonTriangulator, MakesNoFlatTriangleOfCollinearCorners) {
  const std::vector<Eigen::Vector2d> square = {{0, 0}, {1, 0}, {2, 0}, {2, 1},
                                               {2, 2}, {1, 2}, {0, 2}, {0, 1}};
  ExpectTiles(square, Triangulate(MakePolygon(square, kUpright)));
}

TEST(PolygonTriangulator, TilesRandomStarsInRandomPlanes) {
  for (uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    const size_t valence = 4 + random.Below(60);
    const Eigen::Vector2d far(random.Uniform(-50, 50), random.Uniform(-50, 50));
    std::vector<Eigen::Vector2d> points;
    for (size_t i = 0; i < valence; ++i) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(i) /
                           static_cast<double>(valence);
      points.push_back(far +
                       random.Uniform(0.2, 3) *
                           Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
    const Eigen::Matrix3d rotation =
        Eigen::Quaterniond(random.Normal(), random.Normal(), random.Normal(),
                           random.Normal())
            .normalized()
            .toRotationMatrix();
    SCOPED_TRACE("seed " + std::to_string(seed));
    ExpectTiles(points, Triangulate(MakePolygon(points, rotation)));
  }
}

TEST(PolygonTriangulator, TilesACombWithAThousandTeeth) {
  std::vector<Eigen::Vector2d> comb = {{2000, 0}, {2000, -1}, {0, -1}, {0, 0}};
  for (int tooth = 0; tooth < 1000; ++tooth) {
    comb.emplace_back(2 * tooth + 0.5, 5);
    if (tooth < 999) comb.emplace_back(2 * tooth + 1.5, 0.25);
  }
  std::reverse(comb.begin(), comb.end());
  ExpectTiles(comb, Triangulate(MakePolygon(comb, kUpright)));
}

TEST(PolygonTriangulator, CountsWhatIsNoSimplePolygonAndStillFillsIt) {
  for (const std::vector<Eigen::Vector2d>& points :
       {std::vector<Eigen::Vector2d>{{0, 0}, {1, 0}, {2, 0}, {3, 0}},
        std::vector<Eigen::Vector2d>{{1, 1}, {1, 1}, {1, 1}, {1, 1}},
        std::vector<Eigen::Vector2d>{{0, 0}, {4, 4}, {4, 0}, {0, 4}}}) {
    const Polygon polygon = MakePolygon(points, kUpright);
    PolygonTriangulator triangulator(polygon.coordinates, kManyTests);
    std::vector<int32_t> triangles(6, -1);
    ASSERT_THAT(triangulator.Triangulate(polygon.corners, triangles), IsOk());
    EXPECT_EQ(triangulator.num_irregular(), 1);
    for (const int32_t corner : triangles) EXPECT_GE(corner, 0);
  }
}

TEST(PolygonTriangulator, StopsWhenTheTestsAreUsedUp) {
  std::vector<Eigen::Vector2d> star;
  for (int i = 0; i < 1000; ++i) {
    const double angle = 2 * std::numbers::pi * i / 1000;
    star.emplace_back((1 + i % 2) * std::cos(angle),
                      (1 + i % 2) * std::sin(angle));
  }
  const Polygon polygon = MakePolygon(star, kUpright);
  PolygonTriangulator triangulator(polygon.coordinates, 10'000);
  std::vector<int32_t> triangles(3 * 998);
  EXPECT_THAT(triangulator.Triangulate(polygon.corners, triangles),
              StatusIs(absl::StatusCode::kResourceExhausted,
                       HasSubstr("polygon of 1000 vertices")));
}

}  // namespace
}  // namespace argmesh
