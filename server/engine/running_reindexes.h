// Which collections are being reindexed: one run at a time for each.
//
// Thread-safe.
#ifndef ARGMESH_SERVER_ENGINE_RUNNING_REINDEXES_H_
#define ARGMESH_SERVER_ENGINE_RUNNING_REINDEXES_H_

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/engine/collection_record.h"

namespace argmesh {

class RunningReindexes {
 public:
  // The run goes on while it exists. Must not outlive the object it is of.
  class Run {
   public:
    Run(RunningReindexes& all, std::string uid)
        : all_(all), uid_(std::move(uid)) {}
    ~Run();
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;

    // Shapes that are added from now on are described with these, too.
    void WorkTowards(const CollectionSettings& settings);

   private:
    RunningReindexes& all_;
    const std::string uid_;
  };

  // kOverloaded, with a retry delay: it is being reindexed.
  absl::Status CheckIdle(const CollectionRecord& collection) const;
  absl::StatusOr<std::unique_ptr<Run>> Begin(
      const CollectionRecord& collection);

  // What a run works towards; none when there is no run, or no such settings.
  std::optional<CollectionSettings> Goal(std::string_view collection_uid) const;

 private:
  absl::Status CheckIdleLocked(const CollectionRecord& collection) const;

  mutable std::mutex mutex_;
  std::map<std::string, std::optional<CollectionSettings>, std::less<>> runs_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_RUNNING_REINDEXES_H_
