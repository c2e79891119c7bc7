// The windows of a surface: balls of several sizes around points of it, each
// described by how the surface lies inside.
//
// Positions are in units of the square root of the surface's area, about its
// area centroid; WindowFrame leads back to the mesh's own units. Everything
// that is stored is rounded when it is extracted, so that stored and fresh
// windows give equal bits.
#ifndef ARGMESH_CORE_CONTAINMENT_WINDOW_SET_H_
#define ARGMESH_CORE_CONTAINMENT_WINDOW_SET_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace argmesh {

inline constexpr size_t kWindowDims = 24;
using WindowDescriptor = std::array<int8_t, kWindowDims>;

// Radii grow by sqrt 2 from level to level.
inline constexpr int kNumTargetLevels = 9;
inline constexpr double kFirstTargetRadius = 0.03;
inline constexpr int kNumQueryLevels = 7;
inline constexpr double kFirstQueryRadius = 0.06;

inline constexpr int kMaxLevelWindows = 4000;
inline constexpr int kMaxTargetPoints = 32768;

// x_own = origin + x / scale.
struct WindowFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  double scale = 1;  // > 0
};

// A point of the surface and the direction outwards, rounded.
struct PackedPoint {
  std::array<int16_t, 3> position = {};  // in units of kPositionStep
  std::array<int8_t, 2> normal = {};     // octahedral

  bool operator==(const PackedPoint&) const = default;
};

// Coordinates reach +-16; what lies farther out is moved there.
inline constexpr float kPositionStep = 1.0F / 2048;

PackedPoint PackPoint(const Eigen::Vector3f& position,
                      const Eigen::Vector3f& normal);
Eigen::Vector3f UnpackPosition(const PackedPoint& point);
Eigen::Vector3f UnpackNormal(const PackedPoint& point);  // unit

struct WindowLevel {
  std::vector<PackedPoint> frames;            // centre and axis
  std::vector<WindowDescriptor> descriptors;  // as many
};

// What is stored of a shape that may contain a query.
struct TargetWindows {
  WindowFrame frame;
  std::array<WindowLevel, kNumTargetLevels> levels;
  // Samples of the surface, each for an equal share of its area.
  std::vector<PackedPoint> points;
};

struct QueryWindow {
  Eigen::Vector3f position;
  Eigen::Vector3f normal;
  WindowDescriptor descriptor;
  WindowDescriptor flipped;  // were the surface turned inside out
};

struct QueryLevel {
  std::vector<QueryWindow> windows;  // in an order of which any head is spread
  int32_t accepted = 0;  // centres that fit the level; >= windows.size()
};

// What is looked for. Not stored.
struct QueryWindows {
  WindowFrame frame;
  std::array<QueryLevel, kNumQueryLevels> levels;
  std::vector<Eigen::Vector3f> points;  // any head is spread evenly
  std::vector<Eigen::Vector3f> normals;
};

}  // namespace argmesh

#endif  // ARGMESH_CORE_CONTAINMENT_WINDOW_SET_H_
