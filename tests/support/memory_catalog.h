// A Catalog in memory, for tests of the engine and of the rpc layer.
//
// Keeps the whole contract of catalog.h but durability; the port's own test
// suite runs against it as against the real ones. Single calls can be made to
// fail.
#ifndef ARGMESH_TESTS_SUPPORT_MEMORY_CATALOG_H_
#define ARGMESH_TESTS_SUPPORT_MEMORY_CATALOG_H_

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/engine/catalog.h"
#include "server/engine/catalog_errors.h"

namespace argmesh {

class MemoryCatalog : public Catalog {
 public:
  absl::StatusOr<CollectionRecord> InsertCollection(
      const CollectionRecord& record, const RequestStamp& request) override;
  absl::StatusOr<CollectionRecord> UpdateCollection(
      const CollectionPatch& patch) override;
  absl::StatusOr<CollectionDeleted> DeleteCollection(
      const CollectionDelete& removal) override;
  absl::StatusOr<RemovedShapes> RemoveSomeDeleted() override;
  absl::StatusOr<CollectionRecord> GetCollection(
      std::string_view id) const override;
  absl::StatusOr<std::vector<CollectionRecord>> ListCollections(
      std::string_view after_id, int limit) const override;
  absl::StatusOr<ShapeWritten> PutShape(const ShapePut& put) override;
  absl::StatusOr<ShapeWritten> UpdateShape(const ShapePatch& patch) override;
  absl::StatusOr<ShapeDeleted> DeleteShape(const ShapeDelete& removal) override;
  absl::StatusOr<ShapeDeleted> DeleteShapes(
      const ShapesDelete& removal) override;
  absl::StatusOr<ShapeRecord> GetShape(std::string_view collection,
                                       std::string_view id) const override;
  absl::StatusOr<std::vector<ShapeRecord>> ListShapes(
      std::string_view collection, const ShapeSlice& slice) const override;
  absl::StatusOr<StoredGraph> ReadGraph(std::string_view collection,
                                        std::string_view id,
                                        bool with_labels) const override;
  absl::StatusOr<std::vector<ScannedGraph>> ScanGraphs(
      std::string_view collection_uid, std::string_view after_id,
      int limit) const override;
  absl::StatusOr<ScannedGraph> FindGraph(std::string_view collection_uid,
                                         std::string_view id) const override;
  absl::StatusOr<std::string> ReadWindows(std::string_view collection_uid,
                                          std::string_view id) const override;
  absl::StatusOr<std::vector<ShapeChange>> ReadChanges(
      std::string_view collection_uid, int64_t after_generation,
      int limit) const override;
  absl::Status BeginStage(std::string_view collection,
                          std::string_view collection_uid,
                          const SettingsStage& stage) override;
  absl::Status StageShape(const ShapeStaging& staging) override;
  absl::StatusOr<std::vector<std::string>> ListUnstaged(
      std::string_view collection_uid, std::string_view after_id,
      int limit) const override;
  absl::StatusOr<std::vector<ScannedGraph>> ScanStaged(
      std::string_view collection_uid, std::string_view after_id,
      int limit) const override;
  absl::StatusOr<std::optional<CollectionRecord>> SwitchSettings(
      const SettingsSwitch& change) override;
  absl::Status RemoveUnusedGraphs(const StopToken& stop) override;
  absl::Status ForgetChanges(const StopToken& stop) override;
  absl::StatusOr<bool> IsMeshReferenced(
      const Sha256Digest& sha256) const override;
  absl::StatusOr<std::optional<ShapeWritten>> FindPutShape(
      const RequestStamp& request) const override;
  StoreLoad Load() const override { return {}; }
  absl::Status Close() override;

  // Another one with the same content.
  std::unique_ptr<MemoryCatalog> Copy() const;

  // The next PutShape answers `error` and changes nothing.
  void FailNextPut(absl::Status error);
  // Runs `act` once, before the next call of that name does anything.
  void BeforeNextPut(std::function<void()> act);
  void BeforeNextReadGraph(std::function<void()> act);
  // Makes the stored graph unreadable.
  void DamageGraph(std::string_view collection, std::string_view id);

 private:
  struct Staged {
    Sha256Digest sha256{};
    StagedDescription description;
  };
  struct Shape {
    ShapeRecord record;
    uint32_t graph_version = 0;
    std::string graph;
    std::string labels;
    SurfaceDescriptors descriptors;
    bool damaged = false;
    std::optional<Staged> staged;

    // What is put aside is of the present mesh.
    bool IsStaged() const {
      return staged.has_value() && staged->sha256 == record.sha256;
    }
    // What is put aside is what the shape is from now on.
    void TakeStaged();
  };
  struct Collection {
    CollectionRecord record;
    std::optional<SettingsStage> stage;
    std::map<std::string, Shape, std::less<>> shapes;
    std::vector<ShapeChange> changes;
  };
  struct Answer {
    RequestStamp request;
    std::string bytes;
  };
  // What `write` answers; the first answer for a request that was made before.
  // Takes the lock.
  template <typename Result, typename Write>
  absl::StatusOr<Result> Once(const RequestStamp& request,
                              absl::StatusOr<Result> (*parse)(std::string_view),
                              std::string (*serialize)(const Result&),
                              const Write& write) {
    const std::lock_guard lock(mutex_);
    if (closed_) return CatalogClosedError();
    const absl::StatusOr<std::optional<std::string>> answer = Recall(request);
    if (!answer.ok()) return answer.status();
    if (*answer) return parse(**answer);
    absl::StatusOr<Result> written = write();
    if (written.ok()) Remember(request, serialize(*written));
    return written;
  }

  absl::StatusOr<Collection*> Find(std::string_view id);
  absl::StatusOr<const Collection*> Find(std::string_view id) const;
  // The collection, which is still that with `uid`.
  absl::StatusOr<Collection*> Find(std::string_view id, std::string_view uid);
  // The same, at this stage.
  absl::StatusOr<Collection*> FindAtStage(std::string_view id,
                                          std::string_view uid,
                                          const SettingsStage& stage);
  const Collection* FindUid(std::string_view uid) const;
  // What `take(collection, shape)` makes of the shapes after `after_id`, in
  // their order, at most `limit`; none leaves a shape out. Takes the lock.
  template <typename Item, typename Take>
  absl::StatusOr<std::vector<Item>> Page(std::string_view collection_uid,
                                         std::string_view after_id, int limit,
                                         const Take& take) const {
    const std::lock_guard lock(mutex_);
    if (closed_) return CatalogClosedError();
    std::vector<Item> items;
    const Collection* found = FindUid(collection_uid);
    if (found == nullptr) return items;
    for (auto it = found->shapes.upper_bound(after_id);
         it != found->shapes.end() && static_cast<int>(items.size()) < limit;
         ++it) {
      std::optional<Item> item = take(*found, it->second);
      if (item) items.push_back(*std::move(item));
    }
    return items;
  }
  absl::StatusOr<std::optional<std::string>> Recall(
      const RequestStamp& request) const;
  void Remember(const RequestStamp& request, std::string answer);
  int64_t LogChange(Collection& collection, const std::string& id,
                    ShapeChange::Kind kind);
  // The shape, which is there, is so no more.
  ShapeDeleted Erase(Collection& collection, const std::string& id);
  // Calls what is there, without the lock, and leaves nothing there.
  void RunOnce(std::function<void()>& act) const;
  bool IsReferenced(const Sha256Digest& sha256) const;
  std::vector<Sha256Digest> Unreferenced(const ShapeRecord& gone) const;
  static ScannedGraph Scan(const Collection& collection, const Shape& shape);

  mutable std::mutex mutex_;
  bool closed_ = false;
  std::map<std::string, Collection, std::less<>> collections_;
  std::map<std::pair<std::string, std::string>, Answer> answers_;
  absl::Status next_put_;
  std::function<void()> before_put_;
  mutable std::function<void()> before_read_graph_;
};

}  // namespace argmesh

#endif  // ARGMESH_TESTS_SUPPORT_MEMORY_CATALOG_H_
