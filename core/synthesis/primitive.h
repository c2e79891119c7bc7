// Solid primitives with a signed distance: what implicit surfaces are made of.
//
// A primitive lives in a rigid frame given as its pose in the world; its
// distance is negative inside, positive outside and grows at most about as
// fast as the way walked (exact but for ellipsoids).
//
// Source   Hart, "Sphere Tracing", The Visual Computer 12, 1996; the exact
//          distance of a round cone is elementary geometry.
// Cost     O(1), O(outline) for lathes and extrusions. Thread-safe.
#ifndef ARGMESH_CORE_SYNTHESIS_PRIMITIVE_H_
#define ARGMESH_CORE_SYNTHESIS_PRIMITIVE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace argmesh {

// A closed simple polygon, any orientation; the last point joins the first.
using Outline = std::vector<Eigen::Vector2d>;

enum class PrimitiveKind {
  kCapsule,    // two spheres and the cone that touches both
  kEllipsoid,  // about the origin of its frame
  kBox,        // about the origin, rounded outwards
  kTorus,      // around the z axis
  kLathe,      // outline in (distance from the z axis, z)
  kShell,      // wall around an open curve, turned around the z axis
  kExtrusion,  // outline in (x, y), along z in both directions
};

struct Primitive {
  PrimitiveKind kind = PrimitiveKind::kCapsule;
  Eigen::Isometry3d local_of_world = Eigen::Isometry3d::Identity();
  Eigen::Vector3d a = Eigen::Vector3d::Zero();  // ends, radii, half sizes
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double radius_a = 0;
  double radius_b = 0;
  double rounding = 0;  // grown outwards by this
  Outline outline;      // or open curve of a shell

  double Distance(const Eigen::Vector3d& world) const;
  Eigen::AlignedBox3d Bounds() const;
};

// Radii > 0, in world coordinates.
Primitive MakeCapsule(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                      double radius_a, double radius_b);
Primitive MakeEllipsoid(const Eigen::Isometry3d& pose,
                        const Eigen::Vector3d& radii);
// `half` without the rounding.
Primitive MakeBox(const Eigen::Isometry3d& pose, const Eigen::Vector3d& half,
                  double rounding);
Primitive MakeTorus(const Eigen::Isometry3d& pose, double major, double minor);
// First coordinates >= 0; edges on the axis are no surface.
Primitive MakeLathe(const Eigen::Isometry3d& pose, Outline outline,
                    double rounding);
// The wall of `thickness` around the curve of (distance from the z axis, z).
Primitive MakeShell(const Eigen::Isometry3d& pose, Outline curve,
                    double thickness);
Primitive MakeExtrusion(const Eigen::Isometry3d& pose, Outline outline,
                        double half_height, double rounding);

}  // namespace argmesh

#endif  // ARGMESH_CORE_SYNTHESIS_PRIMITIVE_H_
