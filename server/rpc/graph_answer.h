// The answer of ShapeService.GetShapeGraph: a graph and, on request, as many
// face labels as fit in a message.
#ifndef ARGMESH_SERVER_RPC_GRAPH_ANSWER_H_
#define ARGMESH_SERVER_RPC_GRAPH_ANSWER_H_

#include "absl/status/statusor.h"
#include "argmesh/v1/shape_service.pb.h"
#include "server/engine/engine.h"

namespace argmesh {

// FIELD_INVALID, NAME_INVALID, NODE_NOT_FOUND (no such level), and
// RESPONSE_TOO_LARGE when the graph alone does not fit. Blocks; one graph read.
absl::StatusOr<v1::GetShapeGraphResponse> AnswerGraph(
    const Engine& engine, const v1::GetShapeGraphRequest& request);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_GRAPH_ANSWER_H_
