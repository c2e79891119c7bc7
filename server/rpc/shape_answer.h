// A stored shape as an answer of its own: with the summary of its graph.
#ifndef ARGMESH_SERVER_RPC_SHAPE_ANSWER_H_
#define ARGMESH_SERVER_RPC_SHAPE_ANSWER_H_

#include "argmesh/v1/shape.pb.h"
#include "server/engine/engine.h"

namespace argmesh {

// The summary is left out when the graph cannot be read: the shape is there
// nevertheless, and GetShapeGraph says what is wrong. Blocks; one graph read.
v1::Shape AnswerWithGraph(const Engine& engine, const ShapeRecord& record);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_SHAPE_ANSWER_H_
