// Random operations on the SQLite catalog and on one in memory: every answer is
// the same, also after the catalog was closed and opened again.
//
// ARGMESH_MODEL_OPERATIONS operations, 1,500 when not set; from
// ARGMESH_MODEL_SEED, 1 when not set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "core/base/random.h"
#include "server/engine/error_reason.h"
#include "server/engine/record_codec.h"
#include "server/storage/data_directory.h"
#include "server/storage/sqlite_catalog.h"
#include "tests/support/catalog_dump.h"
#include "tests/support/catalog_samples.h"
#include "tests/support/environment_number.h"
#include "tests/support/memory_catalog.h"
#include "tests/support/random_filter.h"
#include "tests/support/temporary_directory.h"

namespace argmesh {
namespace {

constexpr uint64_t kCollections = 4;
constexpr uint64_t kShapeIds = 12;  // ids of each collection
constexpr uint64_t kMeshes = 30;
constexpr double kRestart = 0.004;
constexpr double kCompare = 0.02;
constexpr double kUnused = 0.03;

// Payloads have no order: the reason alone.
std::string Text(const absl::Status& status) {
  const ErrorReason reason = ReasonOf(status).value_or(ErrorReason::kInternal);
  return status.ToString(absl::StatusToStringMode::kWithNoExtraData) + " " +
         std::string(ErrorReasonName(reason));
}

// An answer as text: its bytes, or its error.
template <typename T, typename Show>
std::string Text(const absl::StatusOr<T>& answer, const Show& show) {
  return answer.ok() ? show(*answer) : Text(answer.status());
}

std::string Digests(std::vector<Sha256Digest> digests) {
  std::sort(digests.begin(), digests.end());
  std::string text;
  for (const Sha256Digest& digest : digests) {
    absl::StrAppend(&text, " ", ToHex(digest));
  }
  return text;
}

std::string Show(const ShapeWritten& written) {
  return SerializeShapeWritten(written) + Digests(written.unreferenced);
}

std::string ShowDeleted(const ShapeDeleted& deleted) {
  return SerializeShapeDeleted(deleted) + Digests(deleted.unreferenced);
}

// With all that is left for later.
absl::StatusOr<CollectionDeleted> DeleteWhole(Catalog& catalog,
                                              const CollectionDelete& removal) {
  ARGMESH_ASSIGN_OR_RETURN(CollectionDeleted deleted,
                           catalog.DeleteCollection(removal));
  RemovedShapes removed = {.more = true, .unreferenced = {}};
  while (removed.more) {
    ARGMESH_ASSIGN_OR_RETURN(removed, catalog.RemoveSomeDeleted());
    deleted.unreferenced.insert(deleted.unreferenced.end(),
                                removed.unreferenced.begin(),
                                removed.unreferenced.end());
  }
  return deleted;
}

// One operation on any catalog; the same text from equal catalogs.
using Operation = std::function<std::string(Catalog&)>;

// Keys and values that meet often, also of the wrong type.
std::vector<MetadataKey> RandomKeys(Random& random) {
  std::vector<MetadataKey> keys;
  for (const char* key : {"colour", "mass", "round"}) {
    if (random.Below(3) == 0) continue;
    keys.push_back({key, static_cast<MetadataType>(1 + random.Below(3))});
  }
  return keys;
}

std::map<std::string, std::string> RandomMetadata(Random& random) {
  constexpr const char* kValues[] = {"1", "2", "true", "false", "red", "10"};
  std::map<std::string, std::string> metadata;
  for (const char* key : {"colour", "mass", "round"}) {
    if (random.Below(2) == 0) metadata[key] = kValues[random.Below(6)];
  }
  return metadata;
}

class Operations {
 public:
  explicit Operations(uint64_t seed) : random_(seed) {}

  // What the next one does, in words, comes first in its text.
  Operation Next(Catalog& model) {
    switch (random_.Below(15)) {
      case 0:
        return InsertCollection();
      case 1:
        return random_.Below(4) == 0 ? DeleteCollection(model)
                                     : UpdateCollection(model);
      case 2:
      case 3:
      case 4:
      case 5:
        return PutShape(model);
      case 6:
        return UpdateShape(model);
      case 7:
        return random_.Below(4) == 0 ? DeleteShapes() : DeleteShape(model);
      case 8:
        return random_.Below(4) == 0 ? BeginStage(model)
                                     : SwitchSettings(model);
      case 9:
      case 10:
        return StageShapes(model);
      default:
        return Read(model);
    }
  }

  Random& random() { return random_; }
  int switches() const { return switches_ / 2; }  // in both catalogs

 private:
  std::string CollectionId() {
    return absl::StrCat("c", random_.Below(kCollections));
  }
  std::string ShapeId() { return absl::StrCat("s", random_.Below(kShapeIds)); }

  // Mostly none, sometimes the stored one, sometimes an old one.
  std::string Etag(const std::string& stored) {
    switch (random_.Below(4)) {
      case 0:
        return stored;
      case 1:
        return "\"another\"";
      default:
        return "";
    }
  }
  std::string EtagOfShape(Catalog& model, const std::string& collection,
                          const std::string& id) {
    const auto record = model.GetShape(collection, id);
    return Etag(record.ok() ? ShapeEtag(*record) : "");
  }
  std::string EtagOfCollection(Catalog& model, const std::string& id) {
    const auto record = model.GetCollection(id);
    return Etag(record.ok() ? CollectionEtag(*record) : "");
  }

  // Few ids, so that requests come again, as the same and as others.
  RequestStamp Stamp(std::string_view method, std::string_view asked) {
    if (random_.Below(3) != 0) return {};
    return SampleRequest(static_cast<char>('0' + random_.Below(10)), method,
                         asked);
  }

  Operation InsertCollection() {
    CollectionRecord record = SampleCollection(CollectionId());
    record.metadata_keys = RandomKeys(random_);
    const RequestStamp stamp = Stamp("InsertCollection", record.id);
    return [=](Catalog& catalog) {
      return "insert " + record.id + ": " +
             Text(catalog.InsertCollection(record, stamp),
                  SerializeCollectionRecord);
    };
  }

  Operation UpdateCollection(Catalog& model) {
    CollectionPatch patch;
    patch.id = CollectionId();
    patch.display_name = absl::StrCat("name ", random_.Below(100));
    if (random_.Below(2) == 0) patch.metadata_keys = RandomKeys(random_);
    patch.etag = EtagOfCollection(model, patch.id);
    patch.request = Stamp("UpdateCollection", patch.id);
    patch.update_time = absl::FromUnixSeconds(
        1'700'000'000 + static_cast<int64_t>(random_.Below(1000)));
    return [=](Catalog& catalog) {
      return "update " + patch.id + ": " +
             Text(catalog.UpdateCollection(patch), SerializeCollectionRecord);
    };
  }

  Operation DeleteCollection(Catalog& model) {
    CollectionDelete removal;
    removal.id = CollectionId();
    removal.force = random_.Below(2) == 0;
    removal.etag = EtagOfCollection(model, removal.id);
    removal.request = Stamp("DeleteCollection", removal.id);
    return [=](Catalog& catalog) {
      return "delete " + removal.id + ": " +
             Text(DeleteWhole(catalog, removal),
                  [](const CollectionDeleted& deleted) {
                    return deleted.uid + Digests(deleted.unreferenced);
                  });
    };
  }

  Operation PutShape(Catalog& model) {
    const std::string collection = CollectionId();
    const auto record = model.GetCollection(collection);
    const uint64_t mesh = random_.Below(kMeshes);
    ShapePut put = SamplePut(
        record.ok() ? *record : SampleCollection(collection), ShapeId(), mesh);
    put.record.mesh_stored = random_.Below(4) != 0;
    put.record.metadata = RandomMetadata(random_);
    put.if_exists = static_cast<IfExists>(random_.Below(3));
    put.etag = EtagOfShape(model, collection, put.record.id);
    put.request = Stamp("PutShape", absl::StrCat(put.record.id, mesh));
    if (random_.Below(8) == 0) put.settings = RandomStage().settings;
    if (random_.Below(2) == 0) {
      put.staged = SampleDescription(StageOf(collection), mesh);
    }
    return [=](Catalog& catalog) {
      return "put " + collection + "/" + put.record.id + ": " +
             Text(catalog.PutShape(put), Show);
    };
  }

  Operation UpdateShape(Catalog& model) {
    ShapePatch patch;
    patch.collection = CollectionId();
    patch.id = ShapeId();
    if (random_.Below(2) == 0) patch.display_name = "another name";
    if (random_.Below(2) == 0) patch.source_uri = "file:///elsewhere";
    if (random_.Below(2) == 0) patch.metadata = RandomMetadata(random_);
    patch.etag = EtagOfShape(model, patch.collection, patch.id);
    patch.request = Stamp("UpdateShape", patch.id);
    patch.update_time = absl::FromUnixSeconds(
        1'700'000'000 + static_cast<int64_t>(random_.Below(1000)));
    return [=](Catalog& catalog) {
      return "update " + patch.collection + "/" + patch.id + ": " +
             Text(catalog.UpdateShape(patch), Show);
    };
  }

  Operation DeleteShape(Catalog& model) {
    ShapeDelete removal;
    removal.collection = CollectionId();
    removal.id = ShapeId();
    removal.etag = EtagOfShape(model, removal.collection, removal.id);
    removal.request = Stamp("DeleteShape", removal.id);
    return [=](Catalog& catalog) {
      return "delete " + removal.collection + "/" + removal.id + ": " +
             Text(catalog.DeleteShape(removal), ShowDeleted);
    };
  }

  Operation DeleteShapes() {
    ShapesDelete removal;
    removal.collection = CollectionId();
    for (uint64_t i = 0; i < kShapeIds; ++i) {
      if (random_.Below(3) == 0) removal.ids.push_back(absl::StrCat("s", i));
    }
    removal.request = Stamp("DeleteShapes", absl::StrJoin(removal.ids, ","));
    return [=](Catalog& catalog) {
      return "delete of " + removal.collection + ": " +
             Text(catalog.DeleteShapes(removal), ShowDeleted);
    };
  }

  // Of few, so that stages come again.
  SettingsStage RandomStage() {
    SettingsStage stage =
        SampleStage(500 + 100 * static_cast<int>(random_.Below(3)));
    if (random_.Below(20) == 0) ++stage.graph_version;
    return stage;
  }

  // Mostly the one that was begun last.
  SettingsStage StageOf(const std::string& collection) {
    const auto begun = begun_.find(collection);
    return begun == begun_.end() || random_.Below(6) == 0 ? RandomStage()
                                                          : begun->second;
  }

  Operation BeginStage(Catalog& model) {
    const std::string id = CollectionId();
    const auto record = model.GetCollection(id);
    const std::string uid = record.ok() ? record->uid : "nobody";
    const SettingsStage stage = RandomStage();
    begun_[id] = stage;
    return [=](Catalog& catalog) {
      return "begin stage " + id + ": " +
             Text(catalog.BeginStage(id, uid, stage));
    };
  }

  // Of most shapes, so that some stages come to their end.
  Operation StageShapes(Catalog& model) {
    const auto record = model.GetCollection(CollectionId());
    const CollectionRecord collection =
        record.ok() ? *record : SampleCollection("c0");
    const SettingsStage stage = StageOf(collection.id);
    std::vector<ShapeStaging> stagings;
    for (uint64_t i = 0; i < kShapeIds; ++i) {
      if (random_.Below(16) == 0) continue;
      ShapeStaging& staging = stagings.emplace_back(SampleStaging(
          collection, absl::StrCat("s", i), random_.Below(kMeshes), stage));
      const auto shape = model.GetShape(collection.id, staging.id);
      if (shape.ok() && random_.Below(16) != 0) staging.sha256 = shape->sha256;
    }
    return [=](Catalog& catalog) {
      std::string text = "stage shapes of " + collection.id + ": ";
      for (const ShapeStaging& staging : stagings) {
        text += Text(catalog.StageShape(staging));
      }
      return text;
    };
  }

  Operation SwitchSettings(Catalog& model) {
    SettingsSwitch change;
    change.collection = CollectionId();
    const auto record = model.GetCollection(change.collection);
    change.collection_uid = record.ok() ? record->uid : "nobody";
    change.stage = StageOf(change.collection);
    change.update_time = absl::FromUnixSeconds(
        1'700'000'000 + static_cast<int64_t>(random_.Below(1000)));
    int& switches = switches_;
    return [=, &switches](Catalog& catalog) {
      const auto switched = catalog.SwitchSettings(change);
      if (switched.ok() && *switched) ++switches;
      return "switch " + change.collection + ": " +
             Text(switched, [](const std::optional<CollectionRecord>& found) {
               return found ? SerializeCollectionRecord(*found) : "missing";
             });
    };
  }

  Operation Read(Catalog& model) {
    const std::string collection = CollectionId();
    const std::string id = ShapeId();
    const auto record = model.GetCollection(collection);
    const std::string uid = record.ok() ? record->uid : "nobody";
    ShapeSlice slice{id, static_cast<int>(1 + random_.Below(6)), ""};
    const std::vector<MetadataKey> keys = RandomKeys(random_);
    if (!keys.empty()) slice.filter = MakeRandomFilter(random_, keys).text;
    const Sha256Digest mesh =
        ComputeSha256(absl::StrCat("mesh ", random_.Below(kMeshes)));
    return [=](Catalog& catalog) {
      std::string text = "read " + collection + "/" + id + ": ";
      text += Text(catalog.ReadGraph(collection, id, true),
                   [](const StoredGraph& stored) {
                     return SerializeShapeRecord(stored.record) + stored.graph +
                            stored.labels + stored.signature;
                   });
      text += Text(catalog.ReadWindows(uid, id),
                   [](const std::string& windows) { return windows; });
      text += Text(catalog.ListShapes(collection, slice),
                   [](const std::vector<ShapeRecord>& shapes) {
                     std::string all;
                     for (const auto& s : shapes)
                       all += SerializeShapeRecord(s);
                     return all;
                   });
      text += Text(catalog.IsMeshReferenced(mesh),
                   [](bool yes) { return std::string(yes ? "yes" : "no"); });
      return text;
    };
  }

  Random random_;
  std::map<std::string, SettingsStage> begun_;  // by collection
  int switches_ = 0;
};

class CatalogModelTest : public ::testing::Test {
 protected:
  void Open() {
    auto directory = DataDirectory::Open(
        folder_.path() / "data",
        {.min_free_bytes = 0, .allow_network_file_system = true});
    ASSERT_TRUE(directory.ok()) << directory.status();
    SqliteCatalogOptions options;
    options.removed_at_once = 2;
    auto catalog = SqliteCatalog::Open(*std::move(directory), options);
    ASSERT_TRUE(catalog.ok()) << catalog.status();
    catalog_ = *std::move(catalog);
  }

  const TemporaryDirectory folder_;
  std::unique_ptr<SqliteCatalog> catalog_;
  MemoryCatalog model_;
};

TEST_F(CatalogModelTest, AnswersAsItsTwinInMemoryDoes) {
  const uint64_t seed = EnvironmentNumber("ARGMESH_MODEL_SEED", 1);
  const uint64_t count = EnvironmentNumber("ARGMESH_MODEL_OPERATIONS", 1500);
  Operations operations(seed);
  int restarts = 0;
  ASSERT_NO_FATAL_FAILURE(Open());
  for (uint64_t i = 0; i < count; ++i) {
    const Operation operation = operations.Next(model_);
    const std::string expected = operation(model_);
    const std::string answer = operation(*catalog_);
    ASSERT_TRUE(answer == expected)
        << "seed " << seed << ", operation " << i << ", "
        << expected.substr(0, 200) << " but " << answer.substr(0, 200);
    const double chance = operations.random().Uniform();
    if (chance < kUnused) {
      ASSERT_TRUE(catalog_->RemoveUnusedGraphs({}).ok());
    }
    if (chance < kRestart) {
      ++restarts;
      catalog_.reset();
      ASSERT_NO_FATAL_FAILURE(Open());
    }
    if (chance < kCompare) {
      ASSERT_TRUE(DumpCatalog(*catalog_) == DumpCatalog(model_))
          << "seed " << seed << ", after operation " << i;
    }
  }
  EXPECT_TRUE(DumpCatalog(*catalog_) == DumpCatalog(model_)) << "seed " << seed;
  std::printf(
      "measured: %s operations with %d restarts and %d switches, seed %s: %s\n",
      absl::StrCat(count).c_str(), restarts, operations.switches(),
      absl::StrCat(seed).c_str(),
      HasFailure() ? "differences" : "0 differences");
}

}  // namespace
}  // namespace argmesh
