// Stored shapes made ready for the index of their collection.
#ifndef ARGMESH_SERVER_ENGINE_PARSED_SHAPE_H_
#define ARGMESH_SERVER_ENGINE_PARSED_SHAPE_H_

#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/containment/window_words.h"
#include "server/engine/catalog_requests.h"
#include "server/engine/collection_index.h"
#include "server/engine/compute_pool.h"
#include "server/engine/gallery_snapshot.h"

namespace argmesh {

// A shape as read, whose record may still change.
struct ParsedShape {
  std::shared_ptr<GalleryEntry> entry;
  WindowWords words;
};

// kFailedPrecondition for what another version computed, else kDataLoss or the
// shape's own error.
absl::StatusOr<ParsedShape> ParseScanned(const ScannedGraph& scanned);
// Of each of `page`, on the pool's search threads.
std::vector<absl::StatusOr<ParsedShape>> ParsePage(
    const std::vector<ScannedGraph>& page, ComputePool& pool);

// Puts into the index what was parsed, or that it cannot be used.
void PutParsed(CollectionIndex& index, const std::string& id,
               absl::StatusOr<ParsedShape> shape);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_PARSED_SHAPE_H_
