// Tubes along curves, and the outlines that lathes and extrusions turn into
// solids.
#ifndef ARGMESH_CORE_SYNTHESIS_SWEEP_H_
#define ARGMESH_CORE_SYNTHESIS_SWEEP_H_

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/synthesis/implicit_surface.h"
#include "core/synthesis/primitive.h"

namespace argmesh {

// A point of a tube's centre line and the tube's radius there, > 0.
struct SweepKnot {
  Eigen::Vector3d point;
  double radius = 0;
};

struct SweepOptions {
  double blend = 0;     // with what is there already
  int pieces = 6;       // round cones between two knots, >= 1
  bool closed = false;  // the last knot joins the first
};

// A tube through the knots along a Catmull-Rom curve; at least two knots.
void AddSweep(ImplicitSurface& surface, std::span<const SweepKnot> knots,
              const SweepOptions& options = {});

// A Catmull-Rom curve through the points, `pieces` steps between two.
Outline SmoothCurve(const Outline& points, int pieces, bool closed);

Outline CircleOutline(const Eigen::Vector2d& center, double radius, int points);
Outline RectangleOutline(const Eigen::Vector2d& low,
                         const Eigen::Vector2d& high);

}  // namespace argmesh

#endif  // ARGMESH_CORE_SYNTHESIS_SWEEP_H_
