// Which shapes of a snapshot a search may find.
//
// Chosen before anything is ranked, so that a search for k shapes answers k as
// long as there are so many.
#ifndef ARGMESH_SERVER_ENGINE_SLOT_SELECTION_H_
#define ARGMESH_SERVER_ENGINE_SLOT_SELECTION_H_

#include <cstdint>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/stop_token.h"
#include "server/engine/gallery_snapshot.h"
#include "server/engine/metadata_filter.h"

namespace argmesh {

struct SlotSelection {
  std::vector<bool> slots;  // by slot
  int64_t count = 0;        // that are true
};

// The shapes that `filter` holds for, but not `exclude_id` (empty: none).
// Fails    kCancelled, kDeadlineExceeded
// Cost     about 1 us a shape
absl::StatusOr<SlotSelection> SelectSlots(const GallerySnapshot& gallery,
                                          const MetadataFilter& filter,
                                          std::string_view exclude_id,
                                          const StopToken& stop);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_SLOT_SELECTION_H_
