// Surfaces as samples, and how much of one lies on another.
#ifndef ARGMESH_CORE_CONTAINMENT_SAMPLED_SURFACE_H_
#define ARGMESH_CORE_CONTAINMENT_SAMPLED_SURFACE_H_

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "core/containment/similarity.h"
#include "core/containment/window_set.h"
#include "core/geometry/point_tree.h"

namespace argmesh {

// What is laid on a target. Any head of the samples is spread evenly.
struct LaidSurface {
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;
};

// With `flipped`, normals turned around.
LaidSurface MakeLaidSurface(const QueryWindows& query, bool flipped);

struct SampledSurface {
  PointTree tree;
  std::vector<Eigen::Vector3f> normals;  // by place in the tree
  float spacing = 0;                     // of the samples

  SampledSurface() = default;
  SampledSurface(std::span<const Eigen::Vector3f> points,
                 std::span<const Eigen::Vector3f> unordered_normals,
                 float sample_spacing);
};

SampledSurface MakeSampledSurface(std::span<const PackedPoint> points);

// Mean over laid samples begin .. end-1 of how well each lies on the target,
// 0 .. 1: the cosine of the normals, if positive, times a Gaussian of the
// distance with sd `tau`, a length in the laid surface's own frame. Distances
// along the target count beyond its spacing only.
float Cover(const Similarity& place, const LaidSurface& laid, size_t begin,
            size_t end, const SampledSurface& target, float tau);

// One step of point-to-plane alignment in seven degrees of freedom, over the
// first `count` samples, weighted like Cover. Returns about how far it moved,
// in lengths of the laid surface's own frame; 0 when too few samples lie near.
// The scale stays within a factor of 1.6 of `expected_scale`.
//
// Source   Chen, Medioni, "Object Modelling by Registration of Multiple Range
//          Images", IVC 1992; a weak point-to-point term keeps sliding
//          directions still.
float AlignStep(const LaidSurface& laid, size_t count,
                const SampledSurface& target, float tau, float expected_scale,
                Similarity& place);

}  // namespace argmesh

#endif  // ARGMESH_CORE_CONTAINMENT_SAMPLED_SURFACE_H_
