// The frozen weights and scales of similarities of signatures.
//
// Of the 4,275 pairs of different classes among the odd-numbered meshes of a
// labelled collection (docs/algorithm.md) 1 of 100 is nearer than `half`.
#ifndef ARGMESH_CORE_SIGNATURE_SIMILARITY_SCALE_H_
#define ARGMESH_CORE_SIGNATURE_SIMILARITY_SCALE_H_

namespace argmesh {

struct SimilarityScale {
  double weight;     // of the part in the similarity of signatures, sum 1
  double half;       // the distance whose similarity is 0.5
  double steepness;  // > 0
};

inline constexpr SimilarityScale kPointScale{0.3, 1.03, 10};
inline constexpr SimilarityScale kViewScale{0.7, 0.98, 10};

// 1 / (1 + (d / half)^steepness) of a squared distance d^2 >= 0: 1 at 0,
// decreasing.
double ScaledSimilarity(const SimilarityScale& scale, double squared_distance);

}  // namespace argmesh

#endif  // ARGMESH_CORE_SIGNATURE_SIMILARITY_SCALE_H_
