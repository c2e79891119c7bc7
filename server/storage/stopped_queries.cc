#include "server/storage/stopped_queries.h"

#include <chrono>
#include <utility>

#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks(10);

}  // namespace

StoppedQueries::StoppedQueries(SqliteConnection& connection,
                               const StopToken& stop)
    : db_(connection.handle()),
      stop_(stop),
      watcher_([this](std::stop_token end) { Watch(std::move(end)); }) {}

void StoppedQueries::Watch(std::stop_token end) {
  std::unique_lock lock(mutex_);
  // Again and again: it does not count for a statement that has not begun.
  while (!wake_.wait_for(lock, end, kBetweenLooks,
                         [&end] { return end.stop_requested(); })) {
    if (!stop_.Check().ok()) sqlite3_interrupt(db_);
  }
}

absl::Status OrStopped(absl::Status status, const StopToken& stop) {
  if (!status.ok()) ARGMESH_RETURN_IF_ERROR(stop.Check());
  return status;
}

}  // namespace argmesh
