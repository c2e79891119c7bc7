// Gradient histograms of square patches of an image, turned to the patch's
// dominant direction.
//
// Source   Lowe, "Distinctive Image Features from Scale-Invariant Keypoints",
//          IJCV 2004; square roots as in Arandjelovic, Zisserman, CVPR 2012.
#ifndef ARGMESH_CORE_SIGNATURE_PATCH_HISTOGRAMS_H_
#define ARGMESH_CORE_SIGNATURE_PATCH_HISTOGRAMS_H_

#include <Eigen/Core>
#include <vector>

#include "core/signature/codebook.h"

namespace argmesh {

// Central differences of a square image.
struct GradientImage {
  int size = 0;
  std::vector<float> magnitude;
  std::vector<float> angle;  // in turns, 0 .. 1
};

GradientImage ComputeGradients(const std::vector<float>& image, int size);

struct Patch {
  float x = 0, y = 0;  // centre in pixels
  float side = 0;      // in pixels, > 0
};

// kPatchDims numbers >= 0 of unit length into `histogram`: 4 x 4 cells of 8
// directions. False, and nothing written, where the patch has no gradient.
// Cost O(pixels of the patch), about 15 us for 24 pixels a side.
bool DescribePatch(const GradientImage& gradients, const Patch& patch,
                   Eigen::Ref<Eigen::RowVectorXf> histogram);

}  // namespace argmesh

#endif  // ARGMESH_CORE_SIGNATURE_PATCH_HISTOGRAMS_H_
