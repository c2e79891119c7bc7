#include "server/engine/running_reindexes.h"

#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"

namespace argmesh {
namespace {

constexpr absl::Duration kRetryDelay = absl::Seconds(10);

}  // namespace

RunningReindexes::Run::~Run() {
  const std::lock_guard lock(all_.mutex_);
  all_.runs_.erase(uid_);
}

void RunningReindexes::Run::WorkTowards(const CollectionSettings& settings) {
  const std::lock_guard lock(all_.mutex_);
  all_.runs_[uid_] = settings;
}

absl::Status RunningReindexes::CheckIdleLocked(
    const CollectionRecord& collection) const {
  if (!runs_.contains(collection.uid)) return absl::OkStatus();
  return WithRetryDelay(
      MakeError(ErrorReason::kOverloaded,
                "collection " + collection.id +
                    " is being reindexed: wait for that operation, or cancel "
                    "it",
                {{"collection", collection.id},
                 {"limit", "1"},
                 {"what", "reindexes of a collection"}}),
      kRetryDelay);
}

absl::Status RunningReindexes::CheckIdle(
    const CollectionRecord& collection) const {
  const std::lock_guard lock(mutex_);
  return CheckIdleLocked(collection);
}

absl::StatusOr<std::unique_ptr<RunningReindexes::Run>> RunningReindexes::Begin(
    const CollectionRecord& collection) {
  const std::lock_guard lock(mutex_);
  ARGMESH_RETURN_IF_ERROR(CheckIdleLocked(collection));
  runs_[collection.uid] = std::nullopt;
  return std::make_unique<Run>(*this, collection.uid);
}

std::optional<CollectionSettings> RunningReindexes::Goal(
    std::string_view collection_uid) const {
  const std::lock_guard lock(mutex_);
  const auto it = runs_.find(collection_uid);
  return it == runs_.end() ? std::nullopt : it->second;
}

}  // namespace argmesh
