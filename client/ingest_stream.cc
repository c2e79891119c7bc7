#include "client/ingest_stream.h"

#include <utility>

#include "client/channel_credentials.h"
#include "client/error_status.h"
#include "client/mesh_chunks.h"

namespace argmesh {
namespace {

// How often a wait looks at the stop request and the clock.
constexpr auto kPoll = std::chrono::milliseconds(50);

}  // namespace

IngestStream::IngestStream(v1::IngestService::Stub& stub,
                           const ClientOptions& options,
                           const v1::IngestHello& hello, absl::Duration silence,
                           OnResult on_result)
    : silence_(silence),
      on_result_(std::move(on_result)),
      last_message_(std::chrono::steady_clock::now()) {
  AddKey(options, context_);
  stream_ = stub.IngestShapes(&context_);
  v1::IngestShapesRequest request;
  *request.mutable_hello() = hello;
  // A failed write shows as the end of the stream to the reader.
  stream_->Write(request);
  reader_ = std::thread([this] { ReadAll(); });
}

IngestStream::~IngestStream() {
  if (!finished_) {
    context_.TryCancel();
    reader_.join();
    stream_->Finish();
  }
}

void IngestStream::ReadAll() {
  v1::IngestShapesResponse response;
  while (stream_->Read(&response)) TakeMessage(response);
  const std::lock_guard<std::mutex> lock(mutex_);
  over_ = true;
  changed_.notify_all();
}

void IngestStream::TakeMessage(const v1::IngestShapesResponse& response) {
  // The result is passed on before it counts as arrived, so that Finish
  // returns after the last one has been seen.
  if (response.has_result()) on_result_(response.result());
  const std::lock_guard<std::mutex> lock(mutex_);
  last_message_ = std::chrono::steady_clock::now();
  if (response.has_credit()) {
    credit_items_ += response.credit().items();
    credit_bytes_ += response.credit().bytes();
  }
  if (response.has_result()) in_flight_.erase(response.result().key());
  if (response.has_go_away()) going_away_ = true;
  changed_.notify_all();
}

bool IngestStream::MayBegin(int max_in_flight) const {
  return credit_items_ > 0 && credit_bytes_ > 0 &&
         (max_in_flight <= 0 ||
          in_flight_.size() < static_cast<size_t>(max_in_flight));
}

void IngestStream::WaitUntil(std::unique_lock<std::mutex>& lock,
                             const std::function<bool()>& ready) {
  // Time spent before the wait, reading files say, is not the server's.
  last_message_ = std::chrono::steady_clock::now();
  const auto silence = absl::ToChronoNanoseconds(silence_);
  while (!over_ && !ready()) {
    changed_.wait_for(lock, kPoll);
    if (!silent_ &&
        std::chrono::steady_clock::now() - last_message_ > silence) {
      silent_ = true;
      context_.TryCancel();
    }
  }
}

bool IngestStream::WaitForCredit(int max_in_flight,
                                 const std::stop_token& stop) {
  std::unique_lock<std::mutex> lock(mutex_);
  WaitUntil(lock, [&] {
    return going_away_ || stop.stop_requested() || MayBegin(max_in_flight);
  });
  return !over_ && !going_away_ && !stop.stop_requested();
}

bool IngestStream::Send(const v1::IngestItem& item, std::string_view bytes) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    credit_items_ -= 1;
    credit_bytes_ -= static_cast<int64_t>(bytes.size());
    in_flight_.insert(item.key());
  }
  v1::IngestShapesRequest request;
  *request.mutable_item() = item;
  if (!stream_->Write(request)) return false;
  return ForEachChunk(bytes, [&](std::string_view chunk) {
    request.set_chunk(std::string(chunk));
    return stream_->Write(request);
  });
}

absl::Status IngestStream::Finish() {
  stream_->WritesDone();
  {
    std::unique_lock<std::mutex> lock(mutex_);
    WaitUntil(lock, [] { return false; });
  }
  reader_.join();
  const grpc::Status status = stream_->Finish();
  finished_ = true;
  if (silent_) {
    return MakeStatus(absl::StatusCode::kDeadlineExceeded, "STREAM_SILENT",
                      "the server went silent while shapes were being stored");
  }
  return ToStatus(status);
}

}  // namespace argmesh
