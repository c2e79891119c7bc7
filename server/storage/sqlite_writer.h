// The one thread that writes to the database, and its group commit.
//
// Changes from many threads are run one after the other in one transaction,
// each in a savepoint, and committed together: at most 64 of them, 8 MiB, or
// what comes within 10 ms. A change that fails is rolled back alone. The
// thread also moves the write-ahead log back into the database.
#ifndef ARGMESH_SERVER_STORAGE_SQLITE_WRITER_H_
#define ARGMESH_SERVER_STORAGE_SQLITE_WRITER_H_

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/time/time.h"
#include "server/storage/sqlite_connection.h"

namespace argmesh {

struct SqliteWriterOptions {
  size_t max_queued = 1024;
  int64_t max_queued_bytes = 64LL << 20;
  size_t group_changes = 64;
  int64_t group_bytes = 8LL << 20;
  absl::Duration group_time = absl::Milliseconds(10);
  int64_t passive_checkpoint_bytes = 16LL << 20;  // of the write-ahead log
  int64_t truncate_checkpoint_bytes = 64LL << 20;
};

struct SqliteWriterLoad {
  int64_t commits = 0;
  int64_t changes = 0;         // committed
  absl::Duration commit_time;  // of all commits, from group to disk
  int64_t wal_bytes = 0;
  int64_t queued = 0;
};

class SqliteWriter {
 public:
  // May run more than once only if it was rolled back before.
  using Change = std::function<absl::Status(SqliteConnection&)>;

  // `connection` is the read-write one.
  SqliteWriter(std::unique_ptr<SqliteConnection> connection,
               const SqliteWriterOptions& options);
  ~SqliteWriter();  // Close

  // Returns when the change is durable (OK), or was refused and undone.
  // `bytes` is about what it writes. Fails as `change` does, OVERLOADED when
  // the queue is full, DRAINING after Close, else as SqliteError.
  absl::Status Write(int64_t bytes, const Change& change);

  // Commits what is queued, checkpoints, closes the connection. Idempotent.
  absl::Status Close();

  SqliteWriterLoad Load() const;

 private:
  struct Item {
    const Change* change = nullptr;  // of a caller that waits
    int64_t bytes = 0;
    std::promise<absl::Status> done;
  };
  using Group = std::vector<std::pair<Item, absl::Status>>;

  void Run();
  void RunGroup(Item first);
  // Tells every caller of the group what became of its change.
  void Answer(Group& group, const absl::Status& transaction, absl::Time start);
  absl::Status RunChange(const Change& change);
  std::optional<Item> TakeItem();  // without waiting
  void Checkpoint();
  absl::Status Truncate();
  static int OnCommit(void* writer, sqlite3*, const char*, int pages);

  const SqliteWriterOptions options_;
  std::unique_ptr<SqliteConnection> connection_;
  int64_t page_bytes_ = 0;
  int64_t wal_pages_ = 0;  // the writing thread's

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Item> queue_;
  int64_t queued_bytes_ = 0;
  SqliteWriterLoad load_;
  bool closing_ = false;
  absl::Status closed_;  // of the first Close

  std::mutex close_mutex_;
  std::thread thread_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_SQLITE_WRITER_H_
