#include "server/engine/slot_selection.h"

#include "core/base/status_macros.h"

namespace argmesh {

absl::StatusOr<SlotSelection> SelectSlots(const GallerySnapshot& gallery,
                                          const MetadataFilter& filter,
                                          std::string_view exclude_id,
                                          const StopToken& stop) {
  SlotSelection selection;
  selection.slots.reserve(gallery.blocks.size() * kGalleryBlockSize);
  for (const auto& block : gallery.blocks) {
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    for (const GalleryEntryPtr& entry : *block) {
      const bool selected = entry != nullptr &&
                            entry->record.id != exclude_id &&
                            filter.Matches(entry->record.metadata);
      selection.slots.push_back(selected);
      selection.count += selected ? 1 : 0;
    }
  }
  return selection;
}

}  // namespace argmesh
