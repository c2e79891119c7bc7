#include "server/storage/schema.h"

#include <array>
#include <filesystem>
#include <memory>
#include <vector>

#include "tests/support/status_matchers.h"
#include "tests/support/temporary_directory.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

class MigrateTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_OK_AND_ASSIGN(
        connection_,
        SqliteConnection::Open(path_, SqliteConnection::Mode::kReadWrite));
  }
  int64_t Int(const char* sql) { return connection_->QueryInt(sql).value(); }

  TemporaryDirectory folder_;
  std::filesystem::path path_ = folder_.path() / "test.db";
  std::unique_ptr<SqliteConnection> connection_;
};

TEST_F(MigrateTest, MakesAFreshDatabaseOnce) {
  ASSERT_THAT(Migrate(*connection_, path_, CatalogMigrations()), IsOk());
  EXPECT_EQ(Int("PRAGMA application_id"), kApplicationId);
  EXPECT_EQ(Int("PRAGMA user_version"),
            static_cast<int64_t>(CatalogMigrations().size()));
  EXPECT_EQ(Int("SELECT COUNT(*) FROM pragma_table_list "
                "WHERE name = 'shape' AND strict"),
            1);
  EXPECT_THAT(Migrate(*connection_, path_, CatalogMigrations()), IsOk());
  EXPECT_THAT(CheckDatabase(*connection_), IsOk());
}

TEST_F(MigrateTest, SetsThePragmasThatDurabilityRestsOn) {
  EXPECT_EQ(Int("PRAGMA synchronous"), 2);
  EXPECT_EQ(Int("PRAGMA foreign_keys"), 1);
  EXPECT_EQ(Int("PRAGMA page_size"), 8192);
  EXPECT_EQ(Int("PRAGMA wal_autocheckpoint"), 0);
  EXPECT_EQ(Int("PRAGMA mmap_size"), 0);
  EXPECT_EQ(Int("PRAGMA trusted_schema"), 0);
  EXPECT_EQ(Int("PRAGMA cell_size_check"), 1);
}

TEST_F(MigrateTest, CopiesTheDatabaseBeforeItIsBroughtUpToDate) {
  const std::array<const char*, 2> steps = {
      "CREATE TABLE a(x INTEGER) STRICT; INSERT INTO a VALUES (7);",
      "DROP TABLE a;"};
  ASSERT_THAT(Migrate(*connection_, path_, std::span(steps).first(1)), IsOk());
  ASSERT_THAT(Migrate(*connection_, path_, steps), IsOk());
  EXPECT_EQ(Int("SELECT COUNT(*) FROM sqlite_schema"), 0);
  ASSERT_OK_AND_ASSIGN(
      const std::unique_ptr<SqliteConnection> copy,
      SqliteConnection::Open(path_.string() + ".version-1",
                             SqliteConnection::Mode::kReadWrite));
  EXPECT_EQ(copy->QueryInt("SELECT x FROM a").value(), 7);
}

TEST_F(MigrateTest, LeavesTheOldVersionWhenAStepFails) {
  const std::array<const char*, 2> steps = {
      "CREATE TABLE a(x INTEGER) STRICT;",
      "CREATE TABLE b(x INTEGER) STRICT; CREATE TABLE a(x INTEGER) STRICT;"};
  EXPECT_FALSE(Migrate(*connection_, path_, steps).ok());
  EXPECT_EQ(Int("PRAGMA user_version"), 1);
  EXPECT_EQ(Int("SELECT COUNT(*) FROM sqlite_schema"), 1);
  EXPECT_FALSE(connection_->in_transaction());
}

TEST_F(MigrateTest, RefusesADatabaseWithTablesOfSomethingElse) {
  ASSERT_THAT(connection_->Execute("CREATE TABLE other(x)"), IsOk());
  EXPECT_THAT(Migrate(*connection_, path_, CatalogMigrations()),
              StatusIs(absl::StatusCode::kFailedPrecondition,
                       HasSubstr("no argmesh database")));
}

TEST_F(MigrateTest, FindsRowsThatReferToNothing) {
  ASSERT_THAT(Migrate(*connection_, path_, CatalogMigrations()), IsOk());
  ASSERT_THAT(
      connection_->Execute("PRAGMA foreign_keys=OFF;"
                           "INSERT INTO change_log VALUES (99, 1, 'x', 1)"),
      IsOk());
  EXPECT_THAT(CheckDatabase(*connection_),
              StatusIs(absl::StatusCode::kDataLoss, HasSubstr("change_log")));
}

TEST_F(MigrateTest, OpensReadersThatCannotWriteOrCheckpoint) {
  ASSERT_THAT(Migrate(*connection_, path_, CatalogMigrations()), IsOk());
  ASSERT_OK_AND_ASSIGN(
      const std::unique_ptr<SqliteConnection> reader,
      SqliteConnection::Open(path_, SqliteConnection::Mode::kReadOnly));
  EXPECT_FALSE(reader->Execute("DELETE FROM shape").ok());
  const auto log = std::filesystem::file_size(path_.string() + "-wal");
  EXPECT_GT(log, 0U);
  EXPECT_NE(
      sqlite3_wal_checkpoint_v2(reader->handle(), nullptr,
                                SQLITE_CHECKPOINT_TRUNCATE, nullptr, nullptr),
      SQLITE_OK);
  EXPECT_EQ(std::filesystem::file_size(path_.string() + "-wal"), log);
}

}  // namespace
}  // namespace argmesh
