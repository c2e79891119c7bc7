// The frozen scale of similarities of signatures.
#ifndef ARGMESH_CORE_SIGNATURE_SIMILARITY_SCALE_H_
#define ARGMESH_CORE_SIGNATURE_SIMILARITY_SCALE_H_

namespace argmesh {

// 1 / (1 + (d / kHalfDistance)^kSteepness) of a distance d >= 0: 1 at 0,
// decreasing.
double SimilarityOfDistance(double distance);

}  // namespace argmesh

#endif  // ARGMESH_CORE_SIGNATURE_SIMILARITY_SCALE_H_
