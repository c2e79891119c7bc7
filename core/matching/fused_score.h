// One global score from the two measures of likeness: the graphs' score, which
// says which parts correspond, and the similarity of the shape signatures,
// which sees detail that components average away.
//
// Every summand is on the same frozen scale: 0.5 is what 1 of 100 pairs of
// unlike shapes reaches, 1 is for equal shapes. So a graph's score that any two
// shapes may have adds next to nothing, and what the signatures know of soup or
// of shapes of few parts is not drowned in it. Weights and scale were chosen on
// two labelled collections (docs/algorithm.md).
#ifndef ARGMESH_CORE_MATCHING_FUSED_SCORE_H_
#define ARGMESH_CORE_MATCHING_FUSED_SCORE_H_

#include <cmath>

namespace argmesh {

inline constexpr double kGraphWeight = 0.4;
inline constexpr double kSignatureWeight = 1 - kGraphWeight;

// MatchGlobal's score, 0 .. 1, on the common scale, increasing, 1 at 1.
inline double ScaledGraphScore(double graph_score) {
  constexpr double kHalf = 1 - 0.447;  // of 1 - score
  constexpr double kSteepness = 8;
  return 1 / (1 + std::pow((1 - graph_score) / kHalf, kSteepness));
}

// 0 .. 1; exactly 1 for equal shapes.
inline double FusedScore(double graph_score, double signature_similarity) {
  if (graph_score == 1 && signature_similarity == 1) return 1;
  return kGraphWeight * ScaledGraphScore(graph_score) +
         kSignatureWeight * signature_similarity;
}

}  // namespace argmesh

#endif  // ARGMESH_CORE_MATCHING_FUSED_SCORE_H_
