// Splits a planar polygon into triangles of its own corners.
//
// A polygon that its first corner sees whole (every convex one) becomes a fan
// around that corner; any other simple polygon is cut by ear clipping in the
// plane of its Newell normal. What is neither (crossing itself, no area) still
// gets valence - 2 triangles and is counted.
//
// Source   Meisters, "Polygons Have Ears", Amer. Math. Monthly 82(6), 1975.
// Repeats  equal input gives equal output; ties go to the earlier corner.
// Fails    kResourceExhausted  more point-in-triangle tests than allowed
// Cost     O(valence) for a fan, O(valence^2) for ear clipping, bounded by
//          `max_tests` over all polygons. One object belongs to one thread.
#ifndef ARGMESH_CORE_MESH_POLYGON_TRIANGULATION_H_
#define ARGMESH_CORE_MESH_POLYGON_TRIANGULATION_H_

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "absl/status/status.h"

namespace argmesh {

class PolygonTriangulator {
 public:
  // `coordinates` holds x, y, z of every vertex and must outlive the object.
  PolygonTriangulator(std::span<const double> coordinates, int64_t max_tests);

  // Writes 3 * (valence - 2) vertex indices to `triangles`. The polygon has
  // at least 3 corners, all of them vertices.
  absl::Status Triangulate(std::span<const int32_t> polygon,
                           std::span<int32_t> triangles);

  // Polygons so far that were no simple polygon.
  int64_t num_irregular() const { return num_irregular_; }

 private:
  struct Point {
    double x = 0;
    double y = 0;
    bool operator==(const Point&) const = default;
  };

  bool Project(std::span<const int32_t> polygon);
  bool FanIsValid() const;
  absl::Status ClipEars(std::span<const int32_t> polygon,
                        std::span<int32_t> triangles);
  void Link();
  void Unlink(size_t corner);
  size_t FindEar(size_t start, size_t left);
  void UpdateCorner(size_t corner);
  bool IsEar(size_t corner);
  double Cross(size_t a, size_t b, size_t c) const;

  std::span<const double> coordinates_;
  int64_t tests_left_;
  int64_t num_irregular_ = 0;

  // Of the polygon at hand, by corner.
  std::vector<Point> points_;
  std::vector<size_t> previous_;
  std::vector<size_t> next_;
  std::vector<uint8_t> is_strictly_convex_;
  std::vector<uint8_t> is_ear_;
  double smallest_cross_ = 0;
  int refreshes_left_ = 0;
};

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_POLYGON_TRIANGULATION_H_
