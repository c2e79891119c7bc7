#include "server/storage/sqlite_catalog.h"

#include <sqlite3.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "absl/time/clock.h"
#include "core/base/crc32c.h"
#include "server/engine/error_reason.h"
#include "server/engine/record_codec.h"
#include "server/storage/label_compression.h"
#include "server/storage/schema.h"
#include "tests/support/catalog_samples.h"
#include "tests/support/disk_ballast.h"
#include "tests/support/status_matchers.h"
#include "tests/support/temporary_directory.h"

namespace argmesh {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr DataDirectoryOptions kDirectory{.min_free_bytes = 0,
                                          .allow_network_file_system = true};

absl::StatusOr<std::unique_ptr<SqliteCatalog>> OpenAt(const fs::path& path) {
  ARGMESH_ASSIGN_OR_RETURN(std::shared_ptr<DataDirectory> directory,
                           DataDirectory::Open(path, kDirectory));
  return SqliteCatalog::Open(std::move(directory));
}

// Runs SQL on the database of a catalog that is closed.
void Tamper(const fs::path& data, const std::string& sql) {
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open((data / "catalog.db").c_str(), &db), SQLITE_OK);
  char* error = nullptr;
  EXPECT_EQ(sqlite3_exec(db, sql.c_str(), nullptr, nullptr, &error), SQLITE_OK)
      << error;
  sqlite3_close(db);
}

class SqliteCatalogTest : public ::testing::Test {
 protected:
  void Open() {
    absl::StatusOr<std::unique_ptr<SqliteCatalog>> catalog = OpenAt(data_);
    ASSERT_TRUE(catalog.ok()) << catalog.status();
    catalog_ = *std::move(catalog);
  }
  void Close() {
    ASSERT_THAT(catalog_->Close(), IsOk());
    catalog_.reset();
  }
  // A catalog with the collection "cups" and shapes "s0", "s1", ...
  void Fill(int shapes) {
    Open();
    cups_ = SampleCollection("cups");
    ASSERT_THAT(catalog_->InsertCollection(cups_, {}), IsOk());
    for (int i = 0; i < shapes; ++i) {
      ASSERT_THAT(catalog_->PutShape(SamplePut(cups_, "s" + std::to_string(i),
                                               static_cast<uint64_t>(i))),
                  IsOk());
    }
  }

  // As others see the database while it is open.
  int64_t CountRows(const std::string& table) {
    const auto reader = SqliteConnection::Open(
        data_ / "catalog.db", SqliteConnection::Mode::kReadOnly);
    if (!reader.ok()) return -1;
    return (*reader)->QueryInt("SELECT COUNT(*) FROM " + table).value_or(-1);
  }
  // A database of an older schema version (1 .. 3) that has `put` alone, and
  // remembers that its request was answered.
  void WriteVersion(size_t version, const ShapePut& put) {
    const fs::path path = data_ / "catalog.db";
    ASSERT_OK_AND_ASSIGN(
        const std::unique_ptr<SqliteConnection> connection,
        SqliteConnection::Open(path, SqliteConnection::Mode::kReadWrite));
    ASSERT_THAT(Migrate(*connection, path, CatalogMigrations().first(version)),
                IsOk());
    const std::string settings = SerializeCollectionSettings(cups_.settings);
    const std::string details = SerializeShapeDetails(put.record);
    ASSERT_OK_AND_ASSIGN(const std::string labels, CompressLabels(put.labels));
    const std::string answer =
        SerializeShapeWritten({put.record, cups_.uid, true, {}});
    const auto run = [&](const char* sql, const auto&... values) {
      EXPECT_THAT(connection->Run(sql, values...), IsOk()) << sql;
    };
    run("INSERT INTO collection (id, name, uid, display_name, settings, "
        "graph_version, generation, shape_count, create_us, update_us) VALUES "
        "(5, 'cups', ?, '', ?, ?, 1, 1, 1, 1)",
        cups_.uid, SqliteBlob(settings), cups_.graph_version);
    run("INSERT INTO mesh VALUES (?, 10, 1)", SqliteBlob(put.record.sha256));
    run("INSERT INTO shape VALUES (17, 5, 'red', 'uid', 3, '', ?1, 10, 3, ?1, "
        "'', '', '{}', ?2, 1, 1, 1)",
        SqliteBlob(put.record.sha256), SqliteBlob(details));
    run("INSERT INTO graph VALUES (17, ?, ?, ?)", put.graph_version,
        SqliteBlob(put.graph), ComputeCrc32c(put.graph));
    run("INSERT INTO face_label VALUES (17, ?, ?, ?)",
        static_cast<int64_t>(put.labels.size()), SqliteBlob(labels),
        ComputeCrc32c(labels));
    run("INSERT INTO change_log VALUES (5, 1, 'red', 1)");
    run("INSERT INTO request_dedup VALUES (?, ?, ?, ?, ?, ?)",
        put.request.principal, put.request.request_id, put.request.method,
        SqliteBlob(put.request.hash), SqliteBlob(answer),
        absl::ToUnixMicros(absl::Now() + absl::Hours(1)));
    if (version >= 2) WriteSurface(*connection, put.descriptors);
    if (version >= 3) WriteMetadata(*connection);
  }
  // What came with version 2, and with version 3.
  static void WriteSurface(SqliteConnection& connection,
                           const SurfaceDescriptors& surface) {
    const auto run = [&](const char* sql, const auto&... values) {
      EXPECT_THAT(connection.Run(sql, values...), IsOk()) << sql;
    };
    run("INSERT INTO signature VALUES (17, ?, ?)",
        SqliteBlob(surface.signature), ComputeCrc32c(surface.signature));
    run("INSERT INTO surface_windows VALUES (17, ?, ?, ?, ?)",
        SqliteBlob(surface.window_words), ComputeCrc32c(surface.window_words),
        SqliteBlob(surface.windows), ComputeCrc32c(surface.windows));
  }
  static void WriteMetadata(SqliteConnection& connection) {
    const auto run = [&](const char* sql, const auto&... values) {
      EXPECT_THAT(connection.Run(sql, values...), IsOk()) << sql;
    };
    const std::string keys =
        SerializeMetadataKeys({{"colour", MetadataType::kString}});
    run("UPDATE collection SET metadata_keys = ?", SqliteBlob(keys));
    run("UPDATE shape SET metadata = '{\"colour\":\"red\"}'");
    run("INSERT INTO metadata_value VALUES (5, 'colour', 'red', 17)");
  }

  TemporaryDirectory folder_;
  fs::path data_ = folder_.path() / "data";
  std::unique_ptr<SqliteCatalog> catalog_;
  CollectionRecord cups_;
};

TEST_F(SqliteCatalogTest, HasEverythingAgainAfterARestart) {
  Fill(3);
  ASSERT_OK_AND_ASSIGN(const ShapeRecord before,
                       catalog_->GetShape("cups", "s1"));
  Close();
  Open();
  ASSERT_OK_AND_ASSIGN(const ShapeRecord after,
                       catalog_->GetShape("cups", "s1"));
  EXPECT_TRUE(SameRecord(before, after));
  ASSERT_OK_AND_ASSIGN(const StoredGraph graph,
                       catalog_->ReadGraph("cups", "s2", true));
  EXPECT_EQ(graph.labels, SamplePut(cups_, "s2", 2).labels);
}

TEST_F(SqliteCatalogTest, RemovesManyShapesOfADeletedCollectionInPieces) {
  constexpr int kShapes = 150;
  Fill(kShapes);
  const CollectionRecord mugs = SampleCollection("mugs");
  ASSERT_THAT(catalog_->InsertCollection(mugs, {}), IsOk());
  ASSERT_THAT(catalog_->PutShape(SamplePut(mugs, "s", 3)), IsOk());
  EXPECT_FALSE(catalog_->RemoveSomeDeleted()->more);
  CollectionDelete removal{"cups", /*force=*/true, ""};
  removal.request = SampleRequest('1', "DeleteCollection", "cups");
  ASSERT_OK_AND_ASSIGN(const CollectionDeleted deleted,
                       catalog_->DeleteCollection(removal));
  EXPECT_EQ(deleted.uid, cups_.uid);
  EXPECT_EQ(CountRows("shape"), kShapes + 1);
  EXPECT_EQ(catalog_->Load().deleted_shapes, kShapes);
  // Nobody sees it, and its name may be taken.
  EXPECT_TRUE(absl::IsNotFound(catalog_->GetShape("cups", "s0").status()));
  EXPECT_EQ(catalog_->ScanGraphs(cups_.uid, "", 10)->size(), 0U);
  EXPECT_EQ(catalog_->ReadChanges(cups_.uid, 0, 10)->size(), 0U);
  EXPECT_EQ(catalog_->ListCollections("", 10)->size(), 1U);
  EXPECT_EQ(catalog_->DeleteCollection(removal)->uid, cups_.uid);
  CollectionRecord again = SampleCollection("cups");
  again.uid = "another";
  ASSERT_THAT(catalog_->InsertCollection(again, {}), IsOk());
  ASSERT_THAT(catalog_->PutShape(SamplePut(again, "s", 200)), IsOk());

  ASSERT_OK_AND_ASSIGN(RemovedShapes removed, catalog_->RemoveSomeDeleted());
  EXPECT_TRUE(removed.more);
  EXPECT_EQ(CountRows("shape"), kShapes - 64 + 2);
  EXPECT_EQ(catalog_->Load().deleted_shapes, kShapes - 64);
  size_t unreferenced = removed.unreferenced.size();
  Close();
  Open();
  while (removed.more) {
    ASSERT_OK_AND_ASSIGN(removed, catalog_->RemoveSomeDeleted());
    unreferenced += removed.unreferenced.size();
  }
  EXPECT_EQ(catalog_->Load().deleted_shapes, 0);
  EXPECT_EQ(unreferenced, kShapes - 1U) << "all but the mesh of the mug";
  EXPECT_EQ(CountRows("collection"), 2);
  for (const char* table : {"shape", "graph", "face_label", "mesh", "signature",
                            "surface_windows", "change_log"}) {
    EXPECT_EQ(CountRows(table), 2) << table;
  }
}

TEST_F(SqliteCatalogTest, RefusesASecondOpenOfItsFolder) {
  Fill(0);
  EXPECT_THAT(OpenAt(data_), StatusIs(absl::StatusCode::kFailedPrecondition,
                                      HasSubstr("in use by process " +
                                                std::to_string(getpid()))));
}

TEST_F(SqliteCatalogTest, RefusesADatabaseOfANewerProgram) {
  Fill(1);
  Close();
  Tamper(data_, "PRAGMA user_version=1000");
  EXPECT_THAT(OpenAt(data_), StatusIs(absl::StatusCode::kFailedPrecondition,
                                      HasSubstr("schema version 1000")));
}

TEST_F(SqliteCatalogTest, RefusesADatabaseOfSomethingElse) {
  Fill(1);
  Close();
  Tamper(data_, "PRAGMA application_id=7");
  EXPECT_THAT(OpenAt(data_), StatusIs(absl::StatusCode::kFailedPrecondition,
                                      HasSubstr("no argmesh database")));
}

TEST_F(SqliteCatalogTest, ReportsADamagedGraphAndServesTheOthers) {
  Fill(3);
  Close();
  Tamper(data_,
         "UPDATE graph SET arg = zeroblob(length(arg)) WHERE shape_id = "
         "(SELECT id FROM shape WHERE name = 's1')");
  Open();
  const absl::Status damaged =
      catalog_->ReadGraph("cups", "s1", false).status();
  EXPECT_THAT(damaged,
              StatusIs(absl::StatusCode::kDataLoss, HasSubstr("shape s1")));
  EXPECT_EQ(ReasonOf(damaged), ErrorReason::kStoredDataDamaged);
  EXPECT_THAT(catalog_->ReadGraph("cups", "s2", true), IsOk());
  ASSERT_OK_AND_ASSIGN(const std::vector<ScannedGraph> scanned,
                       catalog_->ScanGraphs(cups_.uid, "", 10));
  ASSERT_EQ(scanned.size(), 3U);
  EXPECT_THAT(scanned[0].status, IsOk());
  EXPECT_THAT(scanned[1].status,
              StatusIs(absl::StatusCode::kDataLoss, HasSubstr("checksum")));
  EXPECT_EQ(scanned[1].record.id, "s1");
  EXPECT_THAT(scanned[2].status, IsOk());
}

TEST_F(SqliteCatalogTest, ReportsRowsThatCannotBeRead) {
  struct Case {
    const char* what;
    const char* sql;
  };
  for (const Case& c : std::vector<Case>{
           {"labels cut", "UPDATE face_label SET labels = x'00'"},
           {"labels gone", "DELETE FROM face_label"},
           {"a lying size",
            "UPDATE face_label SET raw_bytes = 9000000000000000000"},
           {"graph gone", "DELETE FROM graph"},
           {"details cut", "UPDATE shape SET details = x'01'"},
           {"no object", "UPDATE shape SET metadata = '[1]'"},
           {"not text", "UPDATE shape SET metadata = '{\"a\":1}'"}}) {
    const TemporaryDirectory folder;
    data_ = folder.path() / "data";
    Fill(1);
    Close();
    Tamper(data_, c.sql);
    Open();
    EXPECT_THAT(catalog_->ReadGraph("cups", "s0", true),
                StatusIs(absl::StatusCode::kDataLoss, HasSubstr("s0")))
        << c.what;
    Close();
  }
}

TEST_F(SqliteCatalogTest, FindsBrokenReferencesAfterAnUncleanStop) {
  Fill(1);
  Close();
  Tamper(data_, "DELETE FROM mesh");
  ASSERT_TRUE(fs::remove(data_ / "clean"));
  EXPECT_THAT(OpenAt(data_),
              StatusIs(absl::StatusCode::kDataLoss, HasSubstr("table shape")));
}

TEST_F(SqliteCatalogTest, OpensACopyOfItsFolderTakenWhileItWrites) {
  Fill(0);
  std::atomic<int> acknowledged{0};
  std::atomic<bool> stop{false};
  std::thread writer([&] {
    for (int i = 0; !stop; ++i) {
      if (catalog_
              ->PutShape(SamplePut(cups_, "s" + std::to_string(i),
                                   static_cast<uint64_t>(i % 5)))
              .ok()) {
        acknowledged = i + 1;
      }
    }
  });
  while (acknowledged < 20) std::this_thread::yield();
  // As a power cut would leave it: the log first, so that the database is not
  // newer than its log. Nothing is checkpointed meanwhile.
  const fs::path copy = folder_.path() / "copy";
  fs::create_directory(copy);
  const int before = acknowledged;
  fs::copy_file(data_ / "catalog.db", copy / "catalog.db");
  fs::copy_file(data_ / "catalog.db-wal", copy / "catalog.db-wal");
  stop = true;
  writer.join();
  Close();

  data_ = copy;
  Open();
  ASSERT_OK_AND_ASSIGN(const std::vector<ShapeRecord> shapes,
                       catalog_->ListShapes("cups", {"", 1'000'000, ""}));
  EXPECT_GE(static_cast<int>(shapes.size()), before);
  ASSERT_OK_AND_ASSIGN(const CollectionRecord cups,
                       catalog_->GetCollection("cups"));
  EXPECT_EQ(cups.shape_count, static_cast<int64_t>(shapes.size()));
  EXPECT_EQ(cups.generation, cups.shape_count);
  for (const ShapeRecord& shape : shapes) {
    EXPECT_THAT(catalog_->ReadGraph("cups", shape.id, true), IsOk());
  }
}

TEST_F(SqliteCatalogTest, RefusesToGrowWhenTheDiskIsLow) {
  Fill(1);
  Close();
  ASSERT_OK_AND_ASSIGN(
      std::shared_ptr<DataDirectory> directory,
      DataDirectory::Open(data_, {.min_free_bytes = int64_t{1} << 60,
                                  .allow_network_file_system = true}));
  ASSERT_OK_AND_ASSIGN(catalog_, SqliteCatalog::Open(std::move(directory)));
  const absl::Status full =
      catalog_->PutShape(SamplePut(cups_, "s1", 1)).status();
  EXPECT_EQ(ReasonOf(full), ErrorReason::kStoreFull);
  ShapePatch shape;
  shape.collection = "cups";
  shape.id = "s0";
  EXPECT_EQ(ReasonOf(catalog_->UpdateShape(shape).status()),
            ErrorReason::kStoreFull);
  CollectionPatch cups;
  cups.id = "cups";
  EXPECT_EQ(ReasonOf(catalog_->UpdateCollection(cups).status()),
            ErrorReason::kStoreFull);
  EXPECT_THAT(catalog_->GetShape("cups", "s0"), IsOk());
  EXPECT_THAT(catalog_->DeleteShape({"cups", "s0", "", {}}), IsOk());
}

TEST_F(SqliteCatalogTest, FillsFreePagesOfTheDatabaseWhenTheDiskIsLow) {
  Fill(1);
  Close();
  Tamper(data_,
         "CREATE TABLE filler AS SELECT zeroblob(300000000) AS x; "
         "DROP TABLE filler");
  // Too little is free by a third of what the file has room for.
  ASSERT_OK_AND_ASSIGN(
      std::shared_ptr<DataDirectory> directory,
      DataDirectory::Open(data_,
                          {.min_free_bytes = FreeDiskBytes() + 100'000'000,
                           .allow_network_file_system = true}));
  ASSERT_OK_AND_ASSIGN(catalog_, SqliteCatalog::Open(directory));
  EXPECT_EQ(ReasonOf(directory->CheckFreeSpace(0)), ErrorReason::kStoreFull);
  EXPECT_THAT(catalog_->PutShape(SamplePut(cups_, "s1", 1)), IsOk());
}

TEST_F(SqliteCatalogTest, GoesOnWithAStageAfterARestartAndFreesWhatItReplaces) {
  constexpr int kShapes = 150;  // more than are removed at once
  Fill(kShapes);
  const SettingsStage stage = SampleStage(900);
  ASSERT_THAT(catalog_->BeginStage("cups", cups_.uid, stage), IsOk());
  const auto put_aside = [&](int from, int to) {
    for (int i = from; i < to; ++i) {
      ASSERT_THAT(
          catalog_->StageShape(SampleStaging(cups_, "s" + std::to_string(i),
                                             static_cast<uint64_t>(i), stage)),
          IsOk());
    }
  };
  put_aside(0, kShapes / 2);
  Close();
  Open();
  ASSERT_THAT(catalog_->RemoveUnusedGraphs({}), IsOk());
  put_aside(kShapes / 2, kShapes);
  ASSERT_OK_AND_ASSIGN(
      const std::optional<CollectionRecord> switched,
      catalog_->SwitchSettings({"cups", cups_.uid, stage, cups_.update_time}));
  ASSERT_TRUE(switched.has_value());
  EXPECT_EQ(CountRows("graph"), 2 * kShapes);
  const StopToken stopped({}, absl::UnixEpoch());
  EXPECT_FALSE(catalog_->RemoveUnusedGraphs(stopped).ok());
  ASSERT_THAT(catalog_->RemoveUnusedGraphs({}), IsOk());
  EXPECT_EQ(CountRows("graph"), kShapes);
  EXPECT_EQ(CountRows("face_label"), kShapes);
  EXPECT_EQ(CountRows("staged_shape"), 0);
  EXPECT_EQ(CountRows("stage"), 0);
  for (int i = 0; i < kShapes; ++i) {
    ASSERT_OK_AND_ASSIGN(
        const StoredGraph graph,
        catalog_->ReadGraph("cups", "s" + std::to_string(i), true));
    EXPECT_EQ(graph.graph,
              SampleDescription(stage, static_cast<uint64_t>(i)).graph);
  }
}

TEST_F(SqliteCatalogTest, ForgetsTheChangesOfBeforeItWasOpened) {
  Fill(2);
  Close();
  // More than go at once.
  Tamper(data_,
         "WITH RECURSIVE n(i) AS (SELECT 3 UNION ALL SELECT i + 1 FROM n "
         "WHERE i < 2500) INSERT INTO change_log SELECT 1, i, 's0', 1 FROM n; "
         "UPDATE collection SET generation = 2500");
  Open();
  const CollectionRecord jugs = SampleCollection("jugs");
  ASSERT_THAT(catalog_->InsertCollection(jugs, {}), IsOk());
  ASSERT_THAT(catalog_->PutShape(SamplePut(jugs, "new", 1)), IsOk());
  ASSERT_THAT(catalog_->DeleteShape({"cups", "s1", "", {}}), IsOk());
  const StopToken stopped({}, absl::UnixEpoch());
  EXPECT_FALSE(catalog_->ForgetChanges(stopped).ok());
  EXPECT_EQ(CountRows("change_log"), 2502);
  ASSERT_THAT(catalog_->ForgetChanges({}), IsOk());
  EXPECT_EQ(CountRows("change_log"), 2);
  ASSERT_OK_AND_ASSIGN(const std::vector<ShapeChange> changes,
                       catalog_->ReadChanges(cups_.uid, 2500, 10));
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].generation, 2501);
}

TEST_F(SqliteCatalogTest, KeepsOneGraphOfAShapeThatIsReplaced) {
  Fill(1);
  const SettingsStage stage = SampleStage(900);
  ASSERT_THAT(catalog_->BeginStage("cups", cups_.uid, stage), IsOk());
  for (int i = 0; i < 3; ++i) {
    ShapePut put = SamplePut(cups_, "s0", 0);
    put.if_exists = IfExists::kReplace;
    put.staged = SampleDescription(stage, 0);
    ASSERT_THAT(catalog_->PutShape(put), IsOk());
  }
  EXPECT_EQ(CountRows("graph"), 2) << "one of each settings";
  EXPECT_EQ(CountRows("face_label"), 2);
}

class OlderCatalogTest : public SqliteCatalogTest,
                         public ::testing::WithParamInterface<size_t> {};

INSTANTIATE_TEST_SUITE_P(Versions, OlderCatalogTest, ::testing::Values(1, 2, 3),
                         ::testing::PrintToStringParamName());

TEST_P(OlderCatalogTest, IsBroughtUpToDateWithAllThatItHas) {
  const size_t version = GetParam();
  ASSERT_TRUE(fs::create_directories(data_));
  cups_ = SampleCollection("cups");
  ShapePut put = SamplePut(cups_, "red", 1);
  put.request = SampleRequest('7', "CreateShape", "red");
  ASSERT_NO_FATAL_FAILURE(WriteVersion(version, put));
  Open();
  EXPECT_TRUE(
      fs::exists(data_ / ("catalog.db.version-" + std::to_string(version))));
  ASSERT_OK_AND_ASSIGN(const StoredGraph red,
                       catalog_->ReadGraph("cups", "red", true));
  EXPECT_EQ(red.graph, put.graph);
  EXPECT_EQ(red.labels, put.labels);
  EXPECT_EQ(red.settings, cups_.settings);
  EXPECT_TRUE(red.record.mesh_stored);
  EXPECT_TRUE(catalog_->IsMeshReferenced(put.record.sha256).value());
  ASSERT_OK_AND_ASSIGN(const std::vector<ScannedGraph> scanned,
                       catalog_->ScanGraphs(cups_.uid, "", 10));
  ASSERT_EQ(scanned.size(), 1U);
  const bool described = version >= 2;
  EXPECT_EQ(scanned[0].signature, described ? put.descriptors.signature : "");
  EXPECT_EQ(catalog_->ReadWindows(cups_.uid, "red").value(),
            described ? put.descriptors.windows : "");
  if (version >= 3) {
    EXPECT_EQ(catalog_->ListShapes("cups", {"", 10, "colour = \"red\""})
                  .value()
                  .size(),
              1U);
  }
  ASSERT_OK_AND_ASSIGN(const std::optional<ShapeWritten> answered,
                       catalog_->FindPutShape(put.request));
  ASSERT_TRUE(answered.has_value());
  EXPECT_EQ(answered->record.id, "red");
  ASSERT_OK_AND_ASSIGN(const std::vector<ShapeChange> changes,
                       catalog_->ReadChanges(cups_.uid, 0, 10));
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].id, "red");
  // New graphs do not take the numbers of old ones.
  ASSERT_THAT(catalog_->PutShape(SamplePut(cups_, "blue", 2)), IsOk());
  EXPECT_EQ(catalog_->ReadGraph("cups", "red", true).value().graph, put.graph);
  ASSERT_THAT(catalog_->RemoveUnusedGraphs({}), IsOk());
  EXPECT_EQ(CountRows("graph"), 2);
}

TEST_F(SqliteCatalogTest, TakesWritesFromManyThreadsAtOnce) {
  Fill(0);
  constexpr int kThreads = 8;
  constexpr int kEach = 25;
  std::vector<std::thread> threads;
  std::atomic<int> failed{0};
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < kEach; ++i) {
        const std::string id =
            "t" + std::to_string(t) + "-" + std::to_string(i);
        if (!catalog_->PutShape(SamplePut(cups_, id, 1)).ok()) ++failed;
        if (!catalog_->GetShape("cups", id).ok()) ++failed;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(failed, 0);
  ASSERT_OK_AND_ASSIGN(const CollectionRecord cups,
                       catalog_->GetCollection("cups"));
  EXPECT_EQ(cups.generation, kThreads * kEach);
  ASSERT_OK_AND_ASSIGN(
      const std::vector<ShapeChange> changes,
      catalog_->ReadChanges(cups_.uid, 0, 2 * kThreads * kEach));
  for (size_t i = 0; i < changes.size(); ++i) {
    EXPECT_EQ(changes[i].generation, static_cast<int64_t>(i) + 1);
  }
}

}  // namespace
}  // namespace argmesh
