// A data directory with a few shapes and their meshes, for tests of what is
// done with a store as a whole.
#ifndef ARGMESH_TESTS_UNIT_SERVER_STORAGE_STORED_SAMPLES_H_
#define ARGMESH_TESTS_UNIT_SERVER_STORAGE_STORED_SAMPLES_H_

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "server/storage/data_directory.h"
#include "server/storage/directory_mesh_store.h"
#include "server/storage/snapshot_directory.h"
#include "server/storage/sqlite_catalog.h"
#include "tests/support/catalog_samples.h"

namespace argmesh {

class StoredSamples {
 public:
  explicit StoredSamples(std::filesystem::path path) : path_(std::move(path)) {
    Open();
  }
  ~StoredSamples() { Close(); }

  void Open() {
    auto directory = DataDirectory::Open(
        path_, {.min_free_bytes = 0, .allow_network_file_system = true});
    ASSERT_TRUE(directory.ok()) << directory.status();
    directory_ = *directory;
    auto meshes = DirectoryMeshStore::Open(directory_);
    ASSERT_TRUE(meshes.ok()) << meshes.status();
    meshes_ = *std::move(meshes);
    auto snapshots = SnapshotDirectory::Open(directory_, *meshes_);
    ASSERT_TRUE(snapshots.ok()) << snapshots.status();
    snapshots_ = *std::move(snapshots);
    auto catalog = SqliteCatalog::Open(directory_);
    ASSERT_TRUE(catalog.ok()) << catalog.status();
    catalog_ = *std::move(catalog);
  }
  void Close() {
    snapshots_.reset();
    catalog_.reset();
    meshes_.reset();
    directory_.reset();
  }

  void AddCollection(const std::string& id) {
    const auto made = catalog_->InsertCollection(SampleCollection(id), {});
    ASSERT_TRUE(made.ok()) << made.status();
  }
  void AddShape(const std::string& collection, const std::string& id,
                uint64_t seed) {
    const auto record = catalog_->GetCollection(collection);
    ASSERT_TRUE(record.ok()) << record.status();
    ShapePut put = SamplePut(*record, id, seed);
    const std::string bytes =
        "mesh of " + id + std::string(100 + seed, static_cast<char>(seed));
    put.record.sha256 = ComputeSha256(bytes);
    put.record.size_bytes = static_cast<int64_t>(bytes.size());
    auto writer = meshes_->StartWrite(put.record.size_bytes);
    ASSERT_TRUE(writer.ok()) << writer.status();
    ASSERT_TRUE((*writer)->Append(bytes).ok());
    auto staged = (*writer)->Seal();
    ASSERT_TRUE(staged.ok()) << staged.status();
    const auto pin = (*staged)->Publish();
    ASSERT_TRUE(pin.ok()) << pin.status();
    const auto written = catalog_->PutShape(put);
    ASSERT_TRUE(written.ok()) << written.status();
  }

  // Every shape as "collection/id digest", its mesh read and checked.
  std::vector<std::string> Contents() const {
    std::vector<std::string> lines;
    const auto collections = catalog_->ListCollections("", 100);
    if (!collections.ok()) return {collections.status().ToString()};
    for (const CollectionRecord& collection : *collections) {
      const auto shapes = catalog_->ListShapes(collection.id, {"", 100, ""});
      if (!shapes.ok()) return {shapes.status().ToString()};
      for (const ShapeRecord& shape : *shapes) {
        auto reader = meshes_->Open(shape.sha256);
        const auto bytes = reader.ok() ? (*reader)->Read(1 << 20)
                                       : absl::StatusOr<std::string>("missing");
        lines.push_back(collection.id + "/" + shape.id + " " +
                        (bytes.ok() ? ToHex(ComputeSha256(*bytes))
                                    : bytes.status().ToString()));
      }
    }
    return lines;
  }

  const std::filesystem::path& path() const { return path_; }
  DataDirectory& directory() { return *directory_; }
  DirectoryMeshStore& meshes() { return *meshes_; }
  SqliteCatalog& catalog() { return *catalog_; }
  SnapshotDirectory& snapshots() { return *snapshots_; }

 private:
  const std::filesystem::path path_;
  std::shared_ptr<DataDirectory> directory_;
  std::unique_ptr<DirectoryMeshStore> meshes_;
  std::unique_ptr<SqliteCatalog> catalog_;
  std::unique_ptr<SnapshotDirectory> snapshots_;
};

}  // namespace argmesh

#endif  // ARGMESH_TESTS_UNIT_SERVER_STORAGE_STORED_SAMPLES_H_
