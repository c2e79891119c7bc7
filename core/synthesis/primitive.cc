#include "core/synthesis/primitive.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace argmesh {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double Sign(double x) { return x > 0 ? 1.0 : (x < 0 ? -1.0 : 0.0); }

double CapsuleDistance(const Primitive& c, const Vector3d& p) {
  const Vector3d axis = c.b - c.a;
  const double length2 = axis.squaredNorm();
  const double slope = c.radius_a - c.radius_b;
  const double cone2 = length2 - slope * slope;
  const Vector3d from_a = p - c.a;
  if (cone2 <= 1e-12) {  // one sphere holds the other
    return std::min(from_a.norm() - c.radius_a, (p - c.b).norm() - c.radius_b);
  }
  const double y = from_a.dot(axis);
  const double z = y - length2;
  const double x2 = (from_a * length2 - axis * y).squaredNorm();
  const double y2 = y * y * length2;
  const double z2 = z * z * length2;
  const double k = Sign(slope) * slope * slope * x2;
  if (Sign(z) * cone2 * z2 > k) {
    return std::sqrt(x2 + z2) / length2 - c.radius_b;
  }
  if (Sign(y) * cone2 * y2 < k) {
    return std::sqrt(x2 + y2) / length2 - c.radius_a;
  }
  return (std::sqrt(x2 * cone2 / length2) + y * slope) / length2 - c.radius_a;
}

double EllipsoidDistance(const Vector3d& radii, const Vector3d& p) {
  const double k0 = p.cwiseQuotient(radii).norm();
  const double k1 = p.cwiseQuotient(radii.cwiseProduct(radii)).norm();
  if (k1 < 1e-9) return -radii.minCoeff();
  return k0 * (k0 - 1.0) / k1;
}

double BoxDistance(const Vector3d& half, const Vector3d& p) {
  const Vector3d q = p.cwiseAbs() - half;
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
}

// Even-odd inside test and nearest edge in one pass. With `open_axis` edges on
// the line x = 0 bound no material.
double OutlineDistance(const Outline& outline, const Vector2d& p,
                       bool open_axis) {
  double nearest2 = std::numeric_limits<double>::infinity();
  bool inside = false;
  for (size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Vector2d edge = outline[j] - outline[i];
    const Vector2d w = p - outline[i];
    if (!open_axis || outline[i].x() > 0 || outline[j].x() > 0) {
      const double t = std::clamp(w.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
      nearest2 = std::min(nearest2, (w - edge * t).squaredNorm());
    }
    const bool below_i = p.y() >= outline[i].y();
    const bool above_j = p.y() < outline[j].y();
    const bool left = edge.x() * w.y() > edge.y() * w.x();
    if (below_i == above_j && above_j == left) inside = !inside;
  }
  return inside ? -std::sqrt(nearest2) : std::sqrt(nearest2);
}

double LatheDistance(const Outline& outline, const Vector3d& p) {
  return OutlineDistance(outline, {std::hypot(p.x(), p.y()), p.z()}, true);
}

double ShellDistance(const Outline& curve, const Vector3d& p) {
  const Vector2d q(std::hypot(p.x(), p.y()), p.z());
  double nearest2 = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i + 1 < curve.size(); ++i) {
    const Vector2d edge = curve[i + 1] - curve[i];
    const Vector2d w = q - curve[i];
    const double t = std::clamp(w.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    nearest2 = std::min(nearest2, (w - edge * t).squaredNorm());
  }
  return std::sqrt(nearest2);
}

double ExtrusionDistance(const Outline& outline, double half_height,
                         const Vector3d& p) {
  const Vector2d d(OutlineDistance(outline, p.head<2>(), false),
                   std::abs(p.z()) - half_height);
  return std::min(d.maxCoeff(), 0.0) + d.cwiseMax(0.0).norm();
}

Primitive MakePosed(PrimitiveKind kind, const Eigen::Isometry3d& pose) {
  Primitive primitive;
  primitive.kind = kind;
  primitive.local_of_world = pose.inverse();
  return primitive;
}

Eigen::AlignedBox3d LocalBounds(const Primitive& p) {
  const Vector3d round = Vector3d::Constant(p.rounding);
  Eigen::AlignedBox3d box;
  switch (p.kind) {
    case PrimitiveKind::kCapsule:
      box.extend(p.a - Vector3d::Constant(p.radius_a));
      box.extend(p.a + Vector3d::Constant(p.radius_a));
      box.extend(p.b - Vector3d::Constant(p.radius_b));
      box.extend(p.b + Vector3d::Constant(p.radius_b));
      return box;
    case PrimitiveKind::kEllipsoid:
    case PrimitiveKind::kBox:
      return {-p.a - round, p.a + round};
    case PrimitiveKind::kTorus: {
      const double wide = p.radius_a + p.radius_b;
      return {Vector3d(-wide, -wide, -p.radius_b),
              Vector3d(wide, wide, p.radius_b)};
    }
    case PrimitiveKind::kLathe:
    case PrimitiveKind::kShell:
      for (const Vector2d& q : p.outline) {
        box.extend(Vector3d(-q.x(), -q.x(), q.y()));
        box.extend(Vector3d(q.x(), q.x(), q.y()));
      }
      return {box.min() - round, box.max() + round};
    case PrimitiveKind::kExtrusion:
      for (const Vector2d& q : p.outline) {
        box.extend(Vector3d(q.x(), q.y(), -p.radius_a));
        box.extend(Vector3d(q.x(), q.y(), p.radius_a));
      }
      return {box.min() - round, box.max() + round};
  }
  return box;
}

}  // namespace

double Primitive::Distance(const Vector3d& world) const {
  if (kind == PrimitiveKind::kCapsule) return CapsuleDistance(*this, world);
  const Vector3d p = local_of_world * world;
  switch (kind) {
    case PrimitiveKind::kCapsule:
      break;
    case PrimitiveKind::kEllipsoid:
      return EllipsoidDistance(a, p);
    case PrimitiveKind::kBox:
      return BoxDistance(a, p) - rounding;
    case PrimitiveKind::kTorus:
      return std::hypot(std::hypot(p.x(), p.y()) - radius_a, p.z()) - radius_b;
    case PrimitiveKind::kLathe:
      return LatheDistance(outline, p) - rounding;
    case PrimitiveKind::kShell:
      return ShellDistance(outline, p) - rounding;
    case PrimitiveKind::kExtrusion:
      return ExtrusionDistance(outline, radius_a, p) - rounding;
  }
  return std::numeric_limits<double>::infinity();
}

Eigen::AlignedBox3d Primitive::Bounds() const {
  const Eigen::AlignedBox3d local = LocalBounds(*this);
  const Eigen::Isometry3d pose = local_of_world.inverse();
  Eigen::AlignedBox3d world;
  for (int corner = 0; corner < 8; ++corner) {
    world.extend(
        pose *
        local.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
  }
  return world;
}

Primitive MakeCapsule(const Vector3d& a, const Vector3d& b, double radius_a,
                      double radius_b) {
  Primitive primitive;
  primitive.a = a;
  primitive.b = b;
  primitive.radius_a = radius_a;
  primitive.radius_b = radius_b;
  return primitive;
}

Primitive MakeEllipsoid(const Eigen::Isometry3d& pose, const Vector3d& radii) {
  Primitive primitive = MakePosed(PrimitiveKind::kEllipsoid, pose);
  primitive.a = radii;
  return primitive;
}

Primitive MakeBox(const Eigen::Isometry3d& pose, const Vector3d& half,
                  double rounding) {
  Primitive primitive = MakePosed(PrimitiveKind::kBox, pose);
  primitive.a = half;
  primitive.rounding = rounding;
  return primitive;
}

Primitive MakeTorus(const Eigen::Isometry3d& pose, double major, double minor) {
  Primitive primitive = MakePosed(PrimitiveKind::kTorus, pose);
  primitive.radius_a = major;
  primitive.radius_b = minor;
  return primitive;
}

Primitive MakeLathe(const Eigen::Isometry3d& pose, Outline outline,
                    double rounding) {
  Primitive primitive = MakePosed(PrimitiveKind::kLathe, pose);
  primitive.outline = std::move(outline);
  primitive.rounding = rounding;
  return primitive;
}

Primitive MakeShell(const Eigen::Isometry3d& pose, Outline curve,
                    double thickness) {
  Primitive primitive = MakePosed(PrimitiveKind::kShell, pose);
  primitive.outline = std::move(curve);
  primitive.rounding = 0.5 * thickness;
  return primitive;
}

Primitive MakeExtrusion(const Eigen::Isometry3d& pose, Outline outline,
                        double half_height, double rounding) {
  Primitive primitive = MakePosed(PrimitiveKind::kExtrusion, pose);
  primitive.outline = std::move(outline);
  primitive.radius_a = half_height;
  primitive.rounding = rounding;
  return primitive;
}

}  // namespace argmesh
