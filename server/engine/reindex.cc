#include "server/engine/reindex.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <memory>
#include <utility>

#include "absl/time/clock.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"
#include "server/engine/query_resolver.h"
#include "server/engine/request_rules.h"

namespace argmesh {
namespace {

constexpr int kListPage = 1000;

// Stored times have microseconds.
absl::Time NowInMicros() {
  return absl::FromUnixMicros(absl::ToUnixMicros(absl::Now()));
}

}  // namespace

class Reindexer::Rounds {
 public:
  Rounds(ComputePool& pool, const RunControl& control)
      : pool_(pool), control_(control) {}

  using Body =
      std::function<absl::StatusOr<ItemOutcome>(const std::string& id)>;

  // One round; its report is added to those before.
  absl::Status Run(const std::vector<std::string>& ids, const Body& body) {
    RunControl round;
    round.stop = control_.stop;
    const RunProgress before = progress_;
    round.report = [&](const RunProgress& progress) {
      progress_.items = before.items + progress.items;
      progress_.done = before.done + progress.done;
      progress_.failed = before.failed + progress.failed;
      control_.report(progress_);
    };
    ARGMESH_ASSIGN_OR_RETURN(RunReport run, RunItems(pool_, ids, round, body));
    report_.done += run.done;
    report_.were_done += run.were_done;
    report_.failed += run.failed;
    const size_t listed = std::min(
        run.failures.size(), kMaxListedFailures - report_.failures.size());
    std::move(run.failures.begin(),
              run.failures.begin() + static_cast<std::ptrdiff_t>(listed),
              std::back_inserter(report_.failures));
    return absl::OkStatus();
  }

  const StopToken& stop() const { return control_.stop; }
  const RunReport& report() const { return report_; }

 private:
  ComputePool& pool_;
  const RunControl& control_;
  RunProgress progress_;
  RunReport report_;
};

absl::StatusOr<CollectionRecord> Reindexer::Check(
    std::string_view id,
    const std::optional<CollectionSettings>& settings) const {
  ARGMESH_ASSIGN_OR_RETURN(CollectionRecord record, catalog_.GetCollection(id));
  if (settings) {
    ARGMESH_RETURN_IF_ERROR(CheckSettings(*settings));
    if (settings->store_meshes != record.settings.store_meshes) {
      return MakeError(ErrorReason::kFieldInvalid,
                       "settings.store_meshes: is fixed when the collection is "
                       "created",
                       {{"field", "settings.store_meshes"}});
    }
  }
  if (!record.settings.store_meshes) {
    ShapeRecord any;
    any.collection = record.id;
    return MeshNotStoredError(any);
  }
  ARGMESH_RETURN_IF_ERROR(running_.CheckIdle(record));
  return record;
}

absl::StatusOr<ReindexReport> Reindexer::Run(
    const std::string& collection,
    const std::optional<CollectionSettings>& settings,
    const RunControl& control) {
  ReindexReport report;
  ARGMESH_ASSIGN_OR_RETURN(report.collection, Check(collection, settings));
  ARGMESH_ASSIGN_OR_RETURN(const std::unique_ptr<RunningReindexes::Run> running,
                           running_.Begin(report.collection));
  Rounds rounds(pool_, control);
  ARGMESH_ASSIGN_OR_RETURN(
      report.collection,
      DescribeOutdated(std::move(report.collection), rounds));
  if (settings && rounds.report().failed == 0) {
    ARGMESH_ASSIGN_OR_RETURN(
        report.collection,
        SwitchTo(*settings, std::move(report.collection), *running, rounds));
  }
  report.run = rounds.report();
  return report;
}

absl::StatusOr<CollectionRecord> Reindexer::DescribeOutdated(
    CollectionRecord collection, Rounds& rounds) {
  if (collection.graph_version != kShapeGraphVersion) {
    // From here on it takes shapes again.
    CollectionPatch patch;
    patch.id = collection.id;
    patch.graph_version = kShapeGraphVersion;
    patch.update_time = NowInMicros();
    ARGMESH_ASSIGN_OR_RETURN(collection, catalog_.UpdateCollection(patch));
  }
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<std::string> outdated,
                           gallery_.Outdated(collection.id));
  ARGMESH_RETURN_IF_ERROR(rounds.Run(outdated, [&](const std::string& id) {
    return DescribeAnew(collection, id, rounds.stop());
  }));
  return catalog_.GetCollection(collection.id);
}

absl::StatusOr<ItemOutcome> Reindexer::DescribeAnew(
    const CollectionRecord& collection, const std::string& id,
    const StopToken& stop) {
  while (true) {
    absl::StatusOr<ShapeRecord> stored = catalog_.GetShape(collection.id, id);
    absl::Status status = stored.status();
    if (stored.ok()) status = ingest_.DescribeAnew(collection, *stored, stop);
    if (status.ok()) return ItemOutcome::kDone;
    if (absl::IsNotFound(status)) return ItemOutcome::kWasDone;  // deleted
    // The shape was updated meanwhile.
    if (ReasonOf(status) != ErrorReason::kEtagMismatch) return status;
  }
}

absl::StatusOr<ItemOutcome> Reindexer::PutAside(
    const CollectionRecord& collection, const CollectionSettings& settings,
    const std::string& id, const StopToken& stop) {
  std::optional<Sha256Digest> tried;
  absl::Status status;
  while (true) {
    const absl::StatusOr<ShapeRecord> stored =
        catalog_.GetShape(collection.id, id);
    if (absl::IsNotFound(stored.status())) return ItemOutcome::kWasDone;
    ARGMESH_RETURN_IF_ERROR(stored.status());
    // A failure counts only while the shape still has the mesh.
    if (tried == stored->sha256) return status;
    tried = stored->sha256;
    status = ingest_.PutAside(collection, *stored, settings, stop);
    if (status.ok()) return ItemOutcome::kDone;
    if (absl::IsNotFound(status)) return ItemOutcome::kWasDone;  // deleted
    ARGMESH_RETURN_IF_ERROR(stop.Check());
  }
}

absl::StatusOr<std::vector<std::string>> Reindexer::ListUnstaged(
    const CollectionRecord& collection) const {
  std::vector<std::string> ids;
  while (true) {
    ARGMESH_ASSIGN_OR_RETURN(
        const std::vector<std::string> page,
        catalog_.ListUnstaged(collection.uid, ids.empty() ? "" : ids.back(),
                              kListPage));
    if (page.empty()) return ids;
    ids.insert(ids.end(), page.begin(), page.end());
  }
}

absl::StatusOr<CollectionRecord> Reindexer::SwitchTo(
    const CollectionSettings& settings, CollectionRecord collection,
    RunningReindexes::Run& run, Rounds& rounds) {
  const SettingsStage stage{settings, kShapeGraphVersion};
  ARGMESH_RETURN_IF_ERROR(
      catalog_.BeginStage(collection.id, collection.uid, stage));
  if (MakeSameGraphs(settings, collection.settings)) {
    ARGMESH_RETURN_IF_ERROR(catalog_.RemoveUnusedGraphs(rounds.stop()));
    return collection;
  }
  run.WorkTowards(settings);
  std::optional<CollectionRecord> switched;
  std::optional<Gallery::StagedShapes> staged;
  while (!switched) {
    ARGMESH_ASSIGN_OR_RETURN(const std::vector<std::string> unstaged,
                             ListUnstaged(collection));
    ARGMESH_RETURN_IF_ERROR(rounds.Run(unstaged, [&](const std::string& id) {
      return PutAside(collection, settings, id, rounds.stop());
    }));
    if (rounds.report().failed > 0) return collection;
    if (!staged) {
      ARGMESH_ASSIGN_OR_RETURN(staged,
                               gallery_.ReadStaged(collection, rounds.stop()));
    }
    ARGMESH_RETURN_IF_ERROR(rounds.stop().Check());
    ARGMESH_ASSIGN_OR_RETURN(
        switched, gallery_.Switch(collection, *staged, [&] {
          return catalog_.SwitchSettings(
              {collection.id, collection.uid, stage, NowInMicros()});
        }));
  }
  // What is left of it goes at the next start.
  (void)catalog_.RemoveUnusedGraphs(rounds.stop());
  return *std::move(switched);
}

}  // namespace argmesh
