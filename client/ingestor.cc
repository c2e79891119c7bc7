#include "client/ingestor.h"

#include <charconv>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "client/backoff.h"
#include "client/client_parts.h"
#include "client/error_status.h"
#include "client/ingest_stream.h"
#include "client/request_id.h"
#include "core/base/sha256.h"

namespace argmesh {
namespace {

// Of one entry that the server asks to be sent later.
constexpr int kMaxSends = 6;

enum class EntryState { kWaiting, kSent, kReported };

// The state of one Run, over all its streams.
class IngestRun {
 public:
  IngestRun(Client& client, const IngestOptions& options,
            std::span<const IngestEntry> entries,
            const std::function<void(const IngestOutcome&)>& report,
            std::stop_token stop)
      : client_(client),
        options_(options),
        entries_(entries),
        report_(report),
        stop_(std::move(stop)),
        states_(entries.size(), EntryState::kWaiting),
        sends_(entries.size(), 0) {
    for (size_t i = 0; i < entries.size(); ++i) {
      waiting_.push_back(i);
      request_ids_.push_back(NewRequestId());
    }
  }

  absl::Status Run();

 private:
  // Sends what waits, over one stream that is opened by the first entry that
  // has to be sent; the stream's end.
  absl::Status RunStream();
  // The next entry to be sent with its bytes; reports those that need not be
  // or cannot be sent. Nothing when none waits.
  std::optional<std::pair<v1::IngestItem, std::string>> NextItem();
  std::optional<std::pair<v1::IngestItem, std::string>> Prepare(size_t index);
  std::optional<size_t> TakeWaiting();
  void TakeResult(const v1::IngestItemResult& result);
  void Report(const IngestOutcome& outcome);
  // What was sent without a result waits again.
  void RecallSent();
  bool AllReported() const;

  Client& client_;
  const IngestOptions& options_;
  const std::span<const IngestEntry> entries_;
  const std::function<void(const IngestOutcome&)>& report_;
  const std::stop_token stop_;
  std::vector<std::string> request_ids_;  // one for all sends of an entry

  mutable std::mutex mutex_;
  // Guarded by mutex_.
  std::vector<EntryState> states_;
  std::vector<int> sends_;
  std::deque<size_t> waiting_;
  size_t reported_ = 0;

  // An item read while the stream had no credit, kept for the next stream.
  std::optional<std::pair<v1::IngestItem, std::string>> ready_;
};

absl::Status IngestRun::Run() {
  Backoff backoff(options_.reconnect, client_.parts().next_seed.fetch_add(1));
  size_t reported_before = 0;
  while (true) {
    const absl::Status status = RunStream();
    RecallSent();
    if (AllReported()) return absl::OkStatus();
    if (stop_.stop_requested()) {
      return absl::CancelledError("stopped before all shapes were stored");
    }
    if (reported_ != reported_before) backoff.Reset();
    reported_before = reported_;
    // A stream that ends well without all results did so to go away.
    absl::Status failure =
        status.ok() ? absl::UnavailableError("the server ended the stream")
                    : status;
    const auto wait = backoff.Next(failure);
    if (!wait) return failure;
    client_.parts().Wait(*wait, stop_);
  }
}

absl::Status IngestRun::RunStream() {
  if (!ready_) ready_ = NextItem();
  if (!ready_) return absl::OkStatus();
  v1::IngestHello hello;
  hello.set_collection(options_.collection);
  hello.set_create_if_absent(options_.create_if_absent);
  if (options_.settings) *hello.mutable_settings() = *options_.settings;
  IngestStream stream(
      *client_.parts().ingest, client_.options(), hello, options_.silence,
      [this](const v1::IngestItemResult& result) { TakeResult(result); });
  while (ready_ && stream.WaitForCredit(options_.max_in_flight, stop_)) {
    size_t index = 0;
    const std::string& key = ready_->first.key();
    std::from_chars(key.data(), key.data() + key.size(), index);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      states_[index] = EntryState::kSent;
      ++sends_[index];
    }
    const bool sent = stream.Send(ready_->first, ready_->second);
    ready_.reset();
    if (!sent) break;
    ready_ = NextItem();
  }
  return client_.parts().Explain(stream.Finish());
}

std::optional<std::pair<v1::IngestItem, std::string>> IngestRun::NextItem() {
  while (!stop_.stop_requested()) {
    const auto index = TakeWaiting();
    if (!index) return std::nullopt;
    if (auto item = Prepare(*index)) return item;
  }
  return std::nullopt;
}

std::optional<size_t> IngestRun::TakeWaiting() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (waiting_.empty()) return std::nullopt;
  const size_t index = waiting_.front();
  waiting_.pop_front();
  return index;
}

std::optional<std::pair<v1::IngestItem, std::string>> IngestRun::Prepare(
    size_t index) {
  const IngestEntry& entry = entries_[index];
  auto bytes = entry.read();
  if (bytes.ok() && bytes->empty()) {
    bytes = MakeStatus(absl::StatusCode::kInvalidArgument, "MESH_EMPTY",
                       "the file is empty");
  }
  if (!bytes.ok()) {
    Report({.index = index, .status = bytes.status()});
    return std::nullopt;
  }
  v1::IngestItem item;
  item.set_key(std::to_string(index));
  item.set_shape_id(entry.shape_id);
  item.set_format(entry.format);
  item.set_size_bytes(static_cast<int64_t>(bytes->size()));
  item.set_sha256(ToHex(ComputeSha256(*bytes)));
  item.set_display_name(entry.display_name);
  item.set_source_uri(entry.source_uri);
  item.mutable_metadata()->insert(entry.metadata.begin(), entry.metadata.end());
  item.set_existing_shape_policy(options_.existing);
  item.set_request_id(request_ids_[index]);
  if (options_.decide && sends_[index] == 0) {
    const auto decision = options_.decide(index, item.sha256());
    if (!decision.ok() || *decision == IngestDecision::kSkip) {
      Report({.index = index,
              .status = decision.status(),
              .already_stored = decision.ok()});
      return std::nullopt;
    }
  }
  return std::make_pair(std::move(item), *std::move(bytes));
}

void IngestRun::TakeResult(const v1::IngestItemResult& result) {
  size_t index = entries_.size();
  std::from_chars(result.key().data(),
                  result.key().data() + result.key().size(), index);
  IngestOutcome outcome{.index = index};
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (index >= entries_.size() || states_[index] != EntryState::kSent) return;
    if (result.has_error()) {
      outcome.status = ToStatus(result.error());
      if (IsRetryable(outcome.status) && sends_[index] < kMaxSends) {
        // Sent again over the next stream, after its wait.
        return;
      }
    } else {
      outcome.shape = result.shape();
      // An entry sent twice is there because of this very run.
      outcome.already_stored = result.already_stored() && sends_[index] == 1;
    }
  }
  Report(outcome);
}

void IngestRun::Report(const IngestOutcome& outcome) {
  const std::lock_guard<std::mutex> lock(mutex_);
  states_[outcome.index] = EntryState::kReported;
  ++reported_;
  report_(outcome);
}

void IngestRun::RecallSent() {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (size_t i = entries_.size(); i-- > 0;) {
    if (states_[i] != EntryState::kSent) continue;
    states_[i] = EntryState::kWaiting;
    waiting_.push_front(i);
  }
}

bool IngestRun::AllReported() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return reported_ == entries_.size();
}

}  // namespace

Ingestor::Ingestor(Client& client, IngestOptions options)
    : client_(client), options_(std::move(options)) {}

absl::Status Ingestor::Run(
    std::span<const IngestEntry> entries,
    const std::function<void(const IngestOutcome&)>& report,
    std::stop_token stop) {
  IngestRun run(client_, options_, entries, report, std::move(stop));
  return run.Run();
}

}  // namespace argmesh
