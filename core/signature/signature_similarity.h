// How alike two shapes are by their signatures.
//
// The distance of each part, 0 .. 2, becomes a similarity by a frozen
// decreasing function of its own (similarity_scale.h): 1 for equal parts, 0.5
// where 1 of 100 unlike shapes is as near. Their weighted mean is the
// similarity of the signatures, so the same number means the same in every
// collection. Views weigh most: they tell more, and tell it of soup too.
#ifndef ARGMESH_CORE_SIGNATURE_SIGNATURE_SIMILARITY_H_
#define ARGMESH_CORE_SIGNATURE_SIGNATURE_SIMILARITY_H_

#include <array>
#include <cstdint>
#include <vector>

#include "core/signature/shape_signature.h"

namespace argmesh {

// 0 .. 1, symmetric to the bit, exactly 1 for equal signatures. Cost about
// 1 us; a gallery is scanned faster with PackedSignature. Thread-safe.
double SignatureSimilarity(const ShapeSignature& a, const ShapeSignature& b);

// A signature laid out for scanning: 16-bit fixed point, 3.7 KB.
class PackedSignature {
 public:
  explicit PackedSignature(const ShapeSignature& signature);

  // Within 1e-3 of SignatureSimilarity of what was packed; symmetric, exactly
  // 1 for equal signatures. Cost about 0.1 us. Thread-safe.
  friend double SignatureSimilarity(const PackedSignature& a,
                                    const PackedSignature& b);

  const std::array<float, kChiralDims>& chirality() const { return chirality_; }

 private:
  struct Part {
    explicit Part(const std::vector<float>& numbers);

    std::vector<int16_t> values;
    int32_t squared = 0;  // length of values, squared
  };

  static double SquaredDistance(const Part& a, const Part& b);

  Part point_;
  Part view_;
  std::array<float, kChiralDims> chirality_;
};

enum class Handedness {
  kUndecided,  // symmetric, or too different to tell
  kSame,
  kMirrored,
};

// Whether b looks like a or like a's mirror image. Meant for shapes that are
// alike: of others it says little. Symmetric in a and b. Thread-safe.
Handedness CompareHandedness(const ShapeSignature& a, const ShapeSignature& b);
Handedness CompareHandedness(const PackedSignature& a,
                             const PackedSignature& b);

}  // namespace argmesh

#endif  // ARGMESH_CORE_SIGNATURE_SIGNATURE_SIMILARITY_H_
