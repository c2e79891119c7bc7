// Well-formed graphs made from a seed, for tests that need no mesh.
#ifndef ARGMESH_TESTS_SUPPORT_RANDOM_GRAPH_H_
#define ARGMESH_TESTS_SUPPORT_RANDOM_GRAPH_H_

#include <cstdint>
#include <vector>

#include "core/graph/shape_graph.h"

namespace argmesh {

struct RandomGraphOptions {
  std::vector<int> level_nodes = {2, 4, 6, 10};  // coarse to fine
  int uniform_nodes = 12;                        // 0 for none
  int modes = 5;
};

// Satisfies CheckShapeGraph; equal seeds give equal graphs.
ShapeGraph MakeRandomGraph(uint64_t seed,
                           const RandomGraphOptions& options = {});

// The graph with every attribute and distance moved by up to `amount`, still
// well formed.
ShapeGraph PerturbGraph(const ShapeGraph& graph, float amount, uint64_t seed);

// The level without the nodes at and after `num_nodes`, areas renormalised:
// what is left of a shape that was cut.
ArgLevel CutLevel(const ArgLevel& level, int num_nodes);

FaceLabels MakeRandomFaceLabels(uint64_t seed, int num_faces);

}  // namespace argmesh

#endif  // ARGMESH_TESTS_SUPPORT_RANDOM_GRAPH_H_
