// Any bytes behind a valid seal: the parsers refuse them, or what they accept
// is well formed, gives the same bytes again and can be matched.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "core/base/sealed_bytes.h"
#include "core/graph/graph_codec.h"
#include "core/graph/shape_graph.h"
#include "core/matching/match.h"

namespace {

void Require(bool holds) {
  if (!holds) std::abort();
}

void FuzzGraph(const std::string& bytes) {
  const auto graph = argmesh::ParseShapeGraph(bytes);
  if (!graph.ok()) {
    Require(graph.status().code() == absl::StatusCode::kDataLoss);
    return;
  }
  Require(argmesh::CheckShapeGraph(*graph).ok());
  Require(argmesh::SerializeShapeGraph(*graph) == bytes);
  const argmesh::MatchableGraph matchable(*graph);
  const argmesh::MatchableGraph empty{argmesh::ShapeGraph()};
  Require(std::isfinite(argmesh::MatchGlobal(matchable, matchable).score));
  Require(std::isfinite(argmesh::MatchPartial(matchable, empty).score));
}

void FuzzLabels(const std::string& bytes) {
  const auto labels = argmesh::ParseFaceLabels(bytes);
  if (!labels.ok()) {
    Require(labels.status().code() == absl::StatusCode::kDataLoss);
    return;
  }
  Require(argmesh::SerializeFaceLabels(*labels) == bytes);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view payload(reinterpret_cast<const char*>(data), size);
  FuzzGraph(argmesh::SealBytes("ARGG", argmesh::kShapeGraphVersion, payload));
  FuzzLabels(argmesh::SealBytes("ARGL", argmesh::kShapeGraphVersion, payload));
  return 0;
}
