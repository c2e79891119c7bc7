#include "server/storage/sqlite_writer.h"

#include <utility>

#include "absl/time/clock.h"
#include "core/base/status_macros.h"
#include "server/engine/catalog_errors.h"
#include "server/engine/error_reason.h"

namespace argmesh {
namespace {

constexpr int kBusyMilliseconds = 5000;
// How long a truncating checkpoint waits for readers; writers wait with it.
constexpr int kTruncateBusyMilliseconds = 50;

}  // namespace

SqliteWriter::SqliteWriter(std::unique_ptr<SqliteConnection> connection,
                           const SqliteWriterOptions& options)
    : options_(options), connection_(std::move(connection)) {
  page_bytes_ = connection_->QueryInt("PRAGMA page_size").value_or(0);
  sqlite3_wal_hook(connection_->handle(), &SqliteWriter::OnCommit, this);
  thread_ = std::thread([this] { Run(); });
}

SqliteWriter::~SqliteWriter() { (void)Close(); }

int SqliteWriter::OnCommit(void* writer, sqlite3*, const char*, int pages) {
  static_cast<SqliteWriter*>(writer)->wal_pages_ = pages;
  return SQLITE_OK;
}

absl::Status SqliteWriter::Write(int64_t bytes, const Change& change) {
  std::future<absl::Status> done;
  {
    const std::lock_guard lock(mutex_);
    if (closing_) return CatalogClosedError();
    if (queue_.size() >= options_.max_queued ||
        (!queue_.empty() &&
         queued_bytes_ + bytes > options_.max_queued_bytes)) {
      return WithRetryDelay(
          MakeError(ErrorReason::kOverloaded, "too many writes wait already"),
          absl::Seconds(1));
    }
    Item& item = queue_.emplace_back(Item{&change, bytes, {}});
    queued_bytes_ += bytes;
    done = item.done.get_future();
  }
  wake_.notify_one();
  return done.get();
}

std::optional<SqliteWriter::Item> SqliteWriter::TakeItem() {
  const std::lock_guard lock(mutex_);
  if (queue_.empty()) return std::nullopt;
  Item item = std::move(queue_.front());
  queue_.pop_front();
  queued_bytes_ -= item.bytes;
  return item;
}

void SqliteWriter::Run() {
  while (true) {
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return closing_ || !queue_.empty(); });
      if (queue_.empty()) return;
    }
    if (auto item = TakeItem()) RunGroup(*std::move(item));
  }
}

absl::Status SqliteWriter::RunChange(const Change& change) {
  ARGMESH_RETURN_IF_ERROR(connection_->Execute("SAVEPOINT change"));
  absl::Status status = change(*connection_);
  // Some errors (a full disk) end the whole transaction by themselves.
  if (!connection_->in_transaction()) return status;
  if (!status.ok()) {
    ARGMESH_RETURN_IF_ERROR(connection_->Execute("ROLLBACK TO change"));
  }
  ARGMESH_RETURN_IF_ERROR(connection_->Execute("RELEASE change"));
  return status;
}

void SqliteWriter::RunGroup(Item first) {
  const absl::Time start = absl::Now();
  Group group;
  absl::Status transaction = connection_->Execute("BEGIN IMMEDIATE");
  int64_t bytes = 0;
  const auto has_room = [&] {
    return transaction.ok() && group.size() < options_.group_changes &&
           bytes < options_.group_bytes &&
           absl::Now() - start < options_.group_time;
  };
  for (std::optional<Item> item = std::move(first); item.has_value();
       item = has_room() ? TakeItem() : std::nullopt) {
    bytes += item->bytes;
    absl::Status status =
        transaction.ok() ? RunChange(*item->change) : transaction;
    if (transaction.ok() && !connection_->in_transaction()) {
      transaction =
          status.ok() ? absl::InternalError("lost the transaction") : status;
    }
    group.emplace_back(*std::move(item), std::move(status));
  }
  if (transaction.ok()) transaction = connection_->Execute("COMMIT");
  if (connection_->in_transaction()) {
    (void)connection_->Execute("ROLLBACK");
  }
  Answer(group, transaction, start);
  Checkpoint();
}

void SqliteWriter::Answer(Group& group, const absl::Status& transaction,
                          absl::Time start) {
  int64_t committed = 0;
  for (auto& [done, status] : group) {
    if (status.ok()) status = transaction;
    committed += status.ok() ? 1 : 0;
  }
  {
    const std::lock_guard lock(mutex_);
    load_.commits += committed > 0 ? 1 : 0;
    load_.changes += committed;
    load_.commit_time += absl::Now() - start;
    load_.wal_bytes = wal_pages_ * page_bytes_;
  }
  for (auto& [done, status] : group) done.done.set_value(std::move(status));
}

void SqliteWriter::Checkpoint() {
  const int64_t wal_bytes = wal_pages_ * page_bytes_;
  if (wal_bytes <= options_.passive_checkpoint_bytes) return;
  // A failure leaves the log as it is; the next group tries again.
  if (wal_bytes > options_.truncate_checkpoint_bytes) {
    (void)Truncate();
    return;
  }
  int log_pages = 0;
  int done_pages = 0;
  if (sqlite3_wal_checkpoint_v2(connection_->handle(), nullptr,
                                SQLITE_CHECKPOINT_PASSIVE, &log_pages,
                                &done_pages) == SQLITE_OK &&
      log_pages == done_pages) {
    wal_pages_ = 0;  // the next commit starts the log over
  }
}

absl::Status SqliteWriter::Truncate() {
  sqlite3* db = connection_->handle();
  sqlite3_busy_timeout(db, kTruncateBusyMilliseconds);
  const int code = sqlite3_wal_checkpoint_v2(
      db, nullptr, SQLITE_CHECKPOINT_TRUNCATE, nullptr, nullptr);
  sqlite3_busy_timeout(db, kBusyMilliseconds);
  if (code != SQLITE_OK) return SqliteError(db, code, "truncating checkpoint");
  wal_pages_ = 0;
  return absl::OkStatus();
}

absl::Status SqliteWriter::Close() {
  const std::lock_guard close_lock(close_mutex_);
  {
    const std::lock_guard lock(mutex_);
    if (closing_) return closed_;
    closing_ = true;
  }
  wake_.notify_all();
  thread_.join();
  closed_ = Truncate();
  connection_.reset();
  return closed_;
}

SqliteWriterLoad SqliteWriter::Load() const {
  const std::lock_guard lock(mutex_);
  SqliteWriterLoad load = load_;
  load.queued = static_cast<int64_t>(queue_.size());
  return load;
}

}  // namespace argmesh
