#include "server/engine/parsed_shape.h"

#include <cstddef>
#include <utility>

#include "core/base/status_macros.h"
#include "core/containment/window_codec.h"
#include "core/graph/graph_codec.h"
#include "core/signature/signature_codec.h"

namespace argmesh {

absl::StatusOr<ParsedShape> ParseScanned(const ScannedGraph& scanned) {
  ARGMESH_RETURN_IF_ERROR(scanned.status);
  if (scanned.graph_version != kShapeGraphVersion ||
      scanned.signature.empty() || scanned.window_words.empty()) {
    return absl::FailedPreconditionError("computed by another version");
  }
  ARGMESH_ASSIGN_OR_RETURN(const ShapeGraph graph,
                           ParseShapeGraph(scanned.graph));
  ARGMESH_ASSIGN_OR_RETURN(const ShapeSignature signature,
                           DecodeSignature(scanned.signature));
  ParsedShape shape;
  ARGMESH_ASSIGN_OR_RETURN(shape.words, ParseWindowWords(scanned.window_words));
  shape.entry = std::make_shared<GalleryEntry>(GalleryEntry{
      scanned.record, MatchableGraph(graph), PackedSignature(signature)});
  return shape;
}

std::vector<absl::StatusOr<ParsedShape>> ParsePage(
    const std::vector<ScannedGraph>& page, ComputePool& pool) {
  std::vector<absl::StatusOr<ParsedShape>> shapes(page.size());
  pool.ParallelFor(WorkClass::kSearch, static_cast<int64_t>(page.size()),
                   [&](int64_t i) {
                     const auto at = static_cast<size_t>(i);
                     shapes[at] = ParseScanned(page[at]);
                   });
  return shapes;
}

void PutParsed(CollectionIndex& index, const std::string& id,
               absl::StatusOr<ParsedShape> shape) {
  if (shape.ok()) {
    index.Put({std::move(shape->entry), std::move(shape->words)});
  } else if (absl::IsFailedPrecondition(shape.status())) {
    index.PutUnusable(id, CollectionIndex::Unusable::kOutdated);
  } else {
    index.PutUnusable(id, CollectionIndex::Unusable::kDamaged);
  }
}

}  // namespace argmesh
