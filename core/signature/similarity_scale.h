// The frozen weights and scale of similarities of signatures.
#ifndef ARGMESH_CORE_SIGNATURE_SIMILARITY_SCALE_H_
#define ARGMESH_CORE_SIGNATURE_SIMILARITY_SCALE_H_

namespace argmesh {

// Of the squared distance. The ratio, 1.5 between distances, was chosen on
// shapes of two collections (docs/algorithm.md).
inline constexpr double kPointShare = 4.0 / 13;
inline constexpr double kViewShare = 9.0 / 13;

// 1 / (1 + (d / kHalfDistance)^kSteepness) of a distance d >= 0: 1 at 0,
// decreasing.
double SimilarityOfDistance(double distance);

}  // namespace argmesh

#endif  // ARGMESH_CORE_SIGNATURE_SIMILARITY_SCALE_H_
