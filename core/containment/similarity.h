// A similarity transform of space: a proper rotation, one scale, a shift.
#ifndef ARGMESH_CORE_CONTAINMENT_SIMILARITY_H_
#define ARGMESH_CORE_CONTAINMENT_SIMILARITY_H_

#include <Eigen/Core>

namespace argmesh {

// x -> scale * rotation * x + shift.
struct Similarity {
  Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();
  float scale = 1;  // > 0
  Eigen::Vector3f shift = Eigen::Vector3f::Zero();

  Eigen::Vector3f Apply(const Eigen::Vector3f& x) const {
    return scale * (rotation * x) + shift;
  }
  Similarity Inverse() const {
    Similarity inverse;
    inverse.rotation = rotation.transpose();
    inverse.scale = 1 / scale;
    inverse.shift = -inverse.scale * (inverse.rotation * shift);
    return inverse;
  }
};

}  // namespace argmesh

#endif  // ARGMESH_CORE_CONTAINMENT_SIMILARITY_H_
