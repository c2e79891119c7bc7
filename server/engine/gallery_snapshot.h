// One collection's shapes ready for matching, as of one generation.
//
// A snapshot is immutable and shared; a search keeps the one it began with.
#ifndef ARGMESH_SERVER_ENGINE_GALLERY_SNAPSHOT_H_
#define ARGMESH_SERVER_ENGINE_GALLERY_SNAPSHOT_H_

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/containment/window_index.h"
#include "core/containment/window_words.h"
#include "core/matching/match.h"
#include "core/signature/signature_similarity.h"
#include "server/engine/collection_record.h"
#include "server/engine/shape_record.h"

namespace argmesh {

struct GalleryEntry {
  ShapeRecord record;
  MatchableGraph graph;
  PackedSignature signature;
};
using GalleryEntryPtr = std::shared_ptr<const GalleryEntry>;

// What a shape adds to the index of its collection.
struct IndexedShape {
  GalleryEntryPtr entry;
  WindowWords words;
};

// At most kGalleryBlockSize entries, null where a shape went; a change copies
// one block, not all.
using GalleryBlock = std::vector<GalleryEntryPtr>;
inline constexpr size_t kGalleryBlockSize = 128;

struct GallerySnapshot {
  std::string collection;
  std::string collection_uid;
  CollectionSettings settings;
  int64_t switches = 0;  // of settings, since it was loaded
  int64_t generation = 0;
  int64_t size = 0;             // entries
  int64_t damaged_shapes = 0;   // not among the entries
  int64_t outdated_shapes = 0;  // not among the entries
  // A shape keeps its slot, block * kGalleryBlockSize + place, while it is
  // there. The order has no meaning.
  std::vector<std::shared_ptr<const GalleryBlock>> blocks;
  WindowIndex windows;  // by slot

  // Null when no shape has the slot.
  const GalleryEntryPtr& entry(int64_t slot) const {
    const auto at = static_cast<size_t>(slot);
    return (*blocks[at / kGalleryBlockSize])[at % kGalleryBlockSize];
  }
};
using GallerySnapshotPtr = std::shared_ptr<const GallerySnapshot>;

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_GALLERY_SNAPSHOT_H_
