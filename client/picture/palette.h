// Colours: many well distinguishable ones for components, and a scale from
// white to dark for matrices.
//
// The first eight are Okabe and Ito's colours, legible with any common colour
// blindness, their black made a slate; the others are chosen one by one in
// CIELAB, each farthest from those before.
//
// Source   Okabe, Ito, "Color Universal Design", 2008; difference of colours
//          is CIE76 (Euclidean in CIELAB, D65).
#ifndef ARGMESH_CLIENT_PICTURE_PALETTE_H_
#define ARGMESH_CLIENT_PICTURE_PALETTE_H_

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/mesh_write.h"

namespace argmesh {

// Distinct for indices 0 .. 47, then repeating; index >= 0.
RgbColor CategoricalColor(int index);

// One colour per label; negative labels are kPaleGrey.
std::vector<RgbColor> ColorsOfLabels(std::span<const int32_t> labels);

// From white at 0 to a dark blue at 1; value is clamped.
RgbColor ScaleColor(double value);

// L 0 .. 100, a, b.
Eigen::Vector3d LabOfRgb(RgbColor color);
double ColorDifference(RgbColor a, RgbColor b);

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_PICTURE_PALETTE_H_
