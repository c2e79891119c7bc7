#include "server/rpc/shape_answer.h"

#include "server/rpc/convert_graph.h"
#include "server/rpc/convert_shape.h"

namespace argmesh {

v1::Shape AnswerWithGraph(const Engine& engine, const ShapeRecord& record) {
  v1::Shape shape = ToProto(record);
  if (record.state != ShapeState::kActive) return shape;
  const absl::StatusOr<ShapeGraphAnswer> graph =
      engine.GetGraph({.collection = record.collection, .id = record.id},
                      /*with_labels=*/false);
  // A graph of a later version of the shape is not this one's.
  if (graph.ok() && graph->record.generation == record.generation) {
    *shape.mutable_graph() = ToSummary(graph->graph);
  }
  return shape;
}

}  // namespace argmesh
