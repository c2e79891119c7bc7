// One global score from the two measures of likeness: the graphs' score, which
// says which parts correspond, and the similarity of the shape signatures,
// which sees detail that components average away.
//
// Both come on frozen scales, 0 .. 1 with 1 for equal shapes, and so does the
// weighted mean. The weights were chosen on every second mesh of a labelled
// collection; between .5 and .7 little depends on them.
#ifndef ARGMESH_CORE_MATCHING_FUSED_SCORE_H_
#define ARGMESH_CORE_MATCHING_FUSED_SCORE_H_

namespace argmesh {

inline constexpr double kGraphWeight = 0.6;
inline constexpr double kSignatureWeight = 1 - kGraphWeight;

inline double FusedScore(double graph_score, double signature_similarity) {
  // Equal shapes: 1, not 1 - epsilon.
  if (graph_score == 1 && signature_similarity == 1) return 1;
  return kGraphWeight * graph_score + kSignatureWeight * signature_similarity;
}

}  // namespace argmesh

#endif  // ARGMESH_CORE_MATCHING_FUSED_SCORE_H_
