#include "server/storage/sqlite_writer.h"

#include <future>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "server/engine/error_reason.h"
#include "tests/support/status_matchers.h"
#include "tests/support/temporary_directory.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;

class SqliteWriterTest : public ::testing::Test {
 protected:
  void Start(const SqliteWriterOptions& options = {}) {
    absl::StatusOr<std::unique_ptr<SqliteConnection>> connection =
        SqliteConnection::Open(path_, SqliteConnection::Mode::kReadWrite);
    ASSERT_TRUE(connection.ok()) << connection.status();
    ASSERT_THAT((*connection)
                    ->Execute("CREATE TABLE IF NOT EXISTS item("
                              "n INTEGER PRIMARY KEY AUTOINCREMENT, "
                              "value INTEGER NOT NULL UNIQUE) STRICT"),
                IsOk());
    writer_ = std::make_unique<SqliteWriter>(*std::move(connection), options);
  }

  static absl::Status Insert(SqliteConnection& connection, int64_t value) {
    return connection.Run("INSERT INTO item(value) VALUES (?)", value).status();
  }

  std::vector<int64_t> Values() {
    std::vector<int64_t> values;
    absl::StatusOr<std::unique_ptr<SqliteConnection>> connection =
        SqliteConnection::Open(path_, SqliteConnection::Mode::kReadOnly);
    EXPECT_TRUE(connection.ok()) << connection.status();
    absl::StatusOr<SqliteStatement> statement =
        (*connection)->Query("SELECT value FROM item ORDER BY n");
    EXPECT_TRUE(statement.ok()) << statement.status();
    while (statement->Step().value()) values.push_back(statement->Int(0));
    return values;
  }

  // Writes `values` from threads of their own, in order, while the writer is
  // held up, so that they form groups; returns each one's status.
  std::vector<absl::Status> WriteTogether(const std::vector<int64_t>& values) {
    std::promise<void> go;
    std::promise<void> held;
    std::thread holder([&] {
      (void)writer_->Write(1, [&](SqliteConnection&) {
        held.set_value();
        go.get_future().wait();
        return absl::OkStatus();
      });
    });
    held.get_future().wait();
    std::vector<absl::Status> statuses(values.size());
    std::vector<std::thread> threads;
    for (size_t i = 0; i < values.size(); ++i) {
      threads.emplace_back([&, i] {
        statuses[i] = writer_->Write(1, [&, i](SqliteConnection& connection) {
          return Insert(connection, values[i]);
        });
      });
      while (writer_->Load().queued <= static_cast<int64_t>(i)) {
        std::this_thread::yield();
      }
    }
    go.set_value();
    holder.join();
    for (std::thread& thread : threads) thread.join();
    return statuses;
  }

  TemporaryDirectory folder_;
  std::filesystem::path path_ = folder_.path() / "test.db";
  std::unique_ptr<SqliteWriter> writer_;
};

TEST_F(SqliteWriterTest, MakesAChangeVisibleBeforeItReturns) {
  Start();
  ASSERT_THAT(
      writer_->Write(1, [](SqliteConnection& c) { return Insert(c, 7); }),
      IsOk());
  EXPECT_THAT(Values(), ElementsAre(7));
}

TEST_F(SqliteWriterTest, CommitsWaitingChangesTogetherAndInOrder) {
  Start({.group_time = absl::InfiniteDuration()});
  for (const absl::Status& status : WriteTogether({5, 3, 9, 1})) {
    EXPECT_THAT(status, IsOk());
  }
  EXPECT_THAT(Values(), ElementsAre(5, 3, 9, 1));
  EXPECT_EQ(writer_->Load().commits, 1);  // with the change that held it up
  EXPECT_EQ(writer_->Load().changes, 5);
}

TEST_F(SqliteWriterTest, CutsAGroupAtItsLargestSize) {
  Start({.group_changes = 2, .group_time = absl::InfiniteDuration()});
  (void)WriteTogether({1, 2, 3, 4});
  EXPECT_THAT(Values(), ElementsAre(1, 2, 3, 4));
  EXPECT_EQ(writer_->Load().commits, 3);  // hold+1, 2+3, 4
}

TEST_F(SqliteWriterTest, RollsBackABadChangeAndKeepsTheOthersOfItsGroup) {
  Start({.group_time = absl::InfiniteDuration()});
  const std::vector<absl::Status> statuses = WriteTogether({1, 2, 1, 3});
  EXPECT_THAT(statuses[0], IsOk());
  EXPECT_THAT(statuses[1], IsOk());
  EXPECT_EQ(statuses[2].code(), absl::StatusCode::kInternal);
  EXPECT_THAT(statuses[3], IsOk());
  EXPECT_THAT(Values(), ElementsAre(1, 2, 3));
}

TEST_F(SqliteWriterTest, UndoesEverythingAChangeDidBeforeItFailed) {
  Start();
  EXPECT_THAT(writer_->Write(1,
                             [](SqliteConnection& c) -> absl::Status {
                               ARGMESH_RETURN_IF_ERROR(Insert(c, 1));
                               return absl::AbortedError("no");
                             }),
              StatusIs(absl::StatusCode::kAborted, "no"));
  EXPECT_THAT(Values(), ElementsAre());
}

TEST_F(SqliteWriterTest, FailsTheGroupWhoseTransactionIsLost) {
  Start({.group_time = absl::InfiniteDuration()});
  const absl::Status status =
      writer_->Write(1, [](SqliteConnection& c) -> absl::Status {
        ARGMESH_RETURN_IF_ERROR(Insert(c, 1));
        ARGMESH_RETURN_IF_ERROR(c.Execute("ROLLBACK"));
        return absl::OkStatus();
      });
  EXPECT_EQ(status.code(), absl::StatusCode::kInternal);
  EXPECT_THAT(
      writer_->Write(1, [](SqliteConnection& c) { return Insert(c, 2); }),
      IsOk());
  EXPECT_THAT(Values(), ElementsAre(2));
}

TEST_F(SqliteWriterTest, TurnsADatabaseThatMayNotGrowIntoStoreFull) {
  Start();
  const absl::Status status =
      writer_->Write(1, [](SqliteConnection& c) -> absl::Status {
        ARGMESH_RETURN_IF_ERROR(c.Execute("PRAGMA max_page_count=1"));
        return c.Execute(
            "CREATE TABLE big(x); INSERT INTO big VALUES(zeroblob(99999))");
      });
  EXPECT_EQ(ReasonOf(status), ErrorReason::kStoreFull);
  EXPECT_EQ(status.code(), absl::StatusCode::kResourceExhausted);
}

TEST_F(SqliteWriterTest, RefusesMoreThanItsQueueHolds) {
  Start({.max_queued = 1});
  std::promise<void> go;
  std::promise<void> held;
  std::thread holder([&] {
    (void)writer_->Write(1, [&](SqliteConnection&) {
      held.set_value();
      go.get_future().wait();
      return absl::OkStatus();
    });
  });
  held.get_future().wait();
  std::thread waiting([&] {
    EXPECT_THAT(
        writer_->Write(1, [](SqliteConnection& c) { return Insert(c, 1); }),
        IsOk());
  });
  while (writer_->Load().queued < 1) std::this_thread::yield();
  const absl::Status refused =
      writer_->Write(1, [](SqliteConnection& c) { return Insert(c, 2); });
  EXPECT_EQ(ReasonOf(refused), ErrorReason::kOverloaded);
  EXPECT_TRUE(RetryDelayOf(refused).has_value());
  go.set_value();
  holder.join();
  waiting.join();
  EXPECT_THAT(Values(), ElementsAre(1));
}

TEST_F(SqliteWriterTest, BoundsTheLogByCheckpoints) {
  Start({.passive_checkpoint_bytes = 100'000,
         .truncate_checkpoint_bytes = 200'000});
  for (int64_t i = 0; i < 100; ++i) {
    ASSERT_THAT(writer_->Write(1,
                               [i](SqliteConnection& c) -> absl::Status {
                                 ARGMESH_RETURN_IF_ERROR(Insert(c, i));
                                 return c.Execute(
                                     "CREATE TABLE IF NOT EXISTS big(x);"
                                     "INSERT INTO big "
                                     "VALUES(randomblob(20000))");
                               }),
                IsOk());
  }
  EXPECT_LT(std::filesystem::file_size(path_.string() + "-wal"), 400'000U);
  ASSERT_THAT(writer_->Close(), IsOk());
  EXPECT_FALSE(std::filesystem::exists(path_.string() + "-wal"));
}

TEST_F(SqliteWriterTest, RefusesChangesOnceItIsClosed) {
  Start();
  ASSERT_THAT(writer_->Close(), IsOk());
  ASSERT_THAT(writer_->Close(), IsOk());
  EXPECT_EQ(ReasonOf(writer_->Write(
                1, [](SqliteConnection& c) { return Insert(c, 1); })),
            ErrorReason::kDraining);
}

}  // namespace
}  // namespace argmesh
