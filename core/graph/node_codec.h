// The bytes of one node and of one level inside a stored graph.
#ifndef ARGMESH_CORE_GRAPH_NODE_CODEC_H_
#define ARGMESH_CORE_GRAPH_NODE_CODEC_H_

#include "absl/status/statusor.h"
#include "core/base/byte_reader.h"
#include "core/base/byte_writer.h"
#include "core/graph/shape_graph.h"

namespace argmesh {

void WriteLevel(const ArgLevel& level, ByteWriter& writer);

// Fails    kDataLoss  the bytes end early, or a count is over its limit
absl::StatusOr<ArgLevel> ReadLevel(ByteReader& reader);

}  // namespace argmesh

#endif  // ARGMESH_CORE_GRAPH_NODE_CODEC_H_
