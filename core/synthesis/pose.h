// Rigid poses from angles in degrees: the joints of synthetic shapes.
#ifndef ARGMESH_CORE_SYNTHESIS_POSE_H_
#define ARGMESH_CORE_SYNTHESIS_POSE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <numbers>

namespace argmesh {

using Pose = Eigen::Isometry3d;

inline Pose At(double x, double y, double z) {
  return Pose(Eigen::Translation3d(x, y, z));
}

inline Pose At(const Eigen::Vector3d& p) { return At(p.x(), p.y(), p.z()); }

inline Pose Turn(double degrees, const Eigen::Vector3d& axis) {
  return Pose(Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis));
}

inline Pose TurnX(double degrees) {
  return Turn(degrees, Eigen::Vector3d::UnitX());
}
inline Pose TurnY(double degrees) {
  return Turn(degrees, Eigen::Vector3d::UnitY());
}
inline Pose TurnZ(double degrees) {
  return Turn(degrees, Eigen::Vector3d::UnitZ());
}

}  // namespace argmesh

#endif  // ARGMESH_CORE_SYNTHESIS_POSE_H_
