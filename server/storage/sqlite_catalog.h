// The catalog in one SQLite file, the default of a single server.
//
// Writes go through one thread and are durable when they return (WAL,
// synchronous=FULL, group commit); reads run beside them on read-only
// connections. Every graph's CRC-32C is checked when it is read.
#ifndef ARGMESH_SERVER_STORAGE_SQLITE_CATALOG_H_
#define ARGMESH_SERVER_STORAGE_SQLITE_CATALOG_H_

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/engine/catalog.h"
#include "server/storage/data_directory.h"
#include "server/storage/sqlite_readers.h"
#include "server/storage/sqlite_writer.h"

namespace argmesh {

struct SqliteCatalogOptions {
  SqliteWriterOptions writer;
  int max_readers = 8;  // > 0
  // Shapes of a deleted collection that are removed in one write: as many take
  // about a tenth of a second.
  int removed_at_once = 64;  // > 0
};

class SqliteCatalog : public Catalog {
 public:
  // Creates or migrates the database; checks it when the last stop was not
  // clean. Both take time in proportion to it, and leave it as it was when
  // `stop` ends them.
  //
  // Fails    as Migrate and CheckDatabase, and as `stop`
  static absl::StatusOr<std::unique_ptr<SqliteCatalog>> Open(
      std::shared_ptr<DataDirectory> directory,
      const SqliteCatalogOptions& options = {}, const StopToken& stop = {});
  ~SqliteCatalog() override;  // Close

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

  StoreLoad Load() const override;
  absl::Status Close() override;

  SqliteWriterLoad WriterLoad() const { return writer_.Load(); }

 private:
  SqliteCatalog(std::shared_ptr<DataDirectory> directory,
                std::unique_ptr<SqliteConnection> connection,
                const SqliteCatalogOptions& options);

  // For a write of about `bytes` to the database, which may fill its free pages
  // first.
  absl::StatusOr<SpaceClaim> ClaimSpace(int64_t bytes) const;
  // Rows of `sql`, which takes the three.
  absl::StatusOr<std::vector<ScannedGraph>> Scan(
      std::string_view sql, std::string_view collection_uid,
      std::string_view after_id, int limit) const;

  const std::shared_ptr<DataDirectory> directory_;
  const int removed_at_once_;
  SqliteWriter writer_;
  mutable SqliteReaders readers_;
  std::mutex close_mutex_;
  bool closed_ = false;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_SQLITE_CATALOG_H_
