// The global signature of a shape: what it is like as a whole, as two vectors
// whose distances can be compared with every other shape's.
//
// POINT  Fisher vector of twelve quantities at 1,024 points of the surface:
//        two-scale curvature and thickness, occlusion, distances. Survives
//        articulation.
// VIEW   Fisher vector of 3,024 gradient histograms in 42 depth images from
//        all round. Survives everything that does not change the outside.
// Both against a fixed codebook (codebook.h), so that signatures of different
// collections can be compared.
//
// Source   Perronnin, Sanchez, Mensink, "Improving the Fisher Kernel for
//          Large-Scale Image Classification", ECCV 2010; Lowe, "Distinctive
//          Image Features from Scale-Invariant Keypoints", IJCV 2004.
// Input    the surface of RepairMesh, in any unit: soup, open surfaces and
//          several pieces too.
// Ignores  translation, rotation, uniform scale and the order of vertices and
//          faces: copies have the same signature but for rounding, symmetric
//          shapes one nearly the same. Mirrored copies differ in `chirality`
//          and slightly in `view`.
// Repeats  equal input gives bit-equal output.
// Fails    kInvalidArgument     an index or coordinate of the mesh, or an
//                               option outside its range
//          kFailedPrecondition  no face of positive area
//          kInternal            the ray tracer could not be set up
//          kCancelled, kDeadlineExceeded
// Cost     about 0.15 s for 10,000 vertices. Thread-safe.
#ifndef ARGMESH_CORE_SIGNATURE_SHAPE_SIGNATURE_H_
#define ARGMESH_CORE_SIGNATURE_SHAPE_SIGNATURE_H_

#include <array>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "core/base/stop_token.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

inline constexpr int kPointDims = 800;
inline constexpr int kViewDims = 1040;
inline constexpr int kSignatureDims = kPointDims + kViewDims;
inline constexpr int kChiralDims = 8;

struct ShapeSignature {
  // Each of unit length, or all zero where nothing could be measured; every
  // value is one of IEEE 754 half precision, so storing loses nothing.
  std::vector<float> point;  // kPointDims
  std::vector<float> view;   // kViewDims
  // Pseudo-scalars: a mirrored copy has the negative of each, a shape with a
  // plane of symmetry has zeros (chirality.h).
  std::array<float, kChiralDims> chirality{};
  bool smoothed = false;  // noise was removed first

  friend bool operator==(const ShapeSignature&,
                         const ShapeSignature&) = default;
};

struct SignatureOptions {
  // Larger shares of boundary edges keep a surface from being smoothed:
  // smoothing tears holes open. 0 .. 1.
  double max_boundary_share = 0.02;
};

struct SignatureTimes {
  absl::Duration surface;  // canonical order, orientation, smoothing
  absl::Duration points;
  absl::Duration views;
};

absl::StatusOr<ShapeSignature> ComputeShapeSignature(
    const TriangleMesh& repaired, const SignatureOptions& options = {},
    const StopToken& stop = {}, SignatureTimes* times = nullptr);

// kInvalidArgument naming what is wrong: a size, a length that is neither 0
// nor 1, a value that is not finite.
absl::Status CheckShapeSignature(const ShapeSignature& signature);

}  // namespace argmesh

#endif  // ARGMESH_CORE_SIGNATURE_SHAPE_SIGNATURE_H_
