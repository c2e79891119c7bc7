// How the surface lies in one window, as numbers that do not depend on the
// pose or on how densely it is sampled.
//
// Three soft two-dimensional histograms about the axis of the window: height
// against distance from the axis (a spin image), and the tilt of normals and
// their radial part against distance from the centre. Their total is the
// surface's area in the window, not 1: how much surface there is says much.
//
// Source   Johnson, Hebert, "Using Spin Images for Efficient Object
//          Recognition in Cluttered 3D Scenes", PAMI 1999, for the first.
#ifndef ARGMESH_CORE_CONTAINMENT_WINDOW_DESCRIPTOR_H_
#define ARGMESH_CORE_CONTAINMENT_WINDOW_DESCRIPTOR_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "core/geometry/point_tree.h"

namespace argmesh {

inline constexpr size_t kSpinRows = 5;  // distance from the axis
inline constexpr size_t kSpinColumns = 8;
inline constexpr size_t kNormalRows = 4;  // distance from the centre
inline constexpr size_t kNormalColumns = 6;
inline constexpr size_t kSpinBins = kSpinRows * kSpinColumns;
inline constexpr size_t kNormalBins = kNormalRows * kNormalColumns;
inline constexpr size_t kRawDims = kSpinBins + 2 * kNormalBins;

// Square roots of bin contents.
using RawDescriptor = Eigen::Matrix<float, static_cast<int>(kRawDims), 1>;

// Evenly spread samples, some of which a window sees.
struct SampleLayer {
  PointTree tree;
  std::vector<Eigen::Vector3f> normals;  // by place in the tree
};

struct DescribedWindow {
  Eigen::Vector3f position;
  Eigen::Vector3f axis;  // mean normal of the middle, unit
  RawDescriptor raw;
};

// Cost: O(samples in the window), about 15 us for 250.
DescribedWindow DescribeWindow(const SampleLayer& layer,
                               const Eigen::Vector3f& position,
                               const Eigen::Vector3f& normal, float radius);

// The descriptor were the surface turned inside out.
RawDescriptor FlipDescriptor(const RawDescriptor& raw);

}  // namespace argmesh

#endif  // ARGMESH_CORE_CONTAINMENT_WINDOW_DESCRIPTOR_H_
