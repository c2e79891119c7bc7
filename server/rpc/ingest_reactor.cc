#include "server/rpc/ingest_reactor.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "core/base/status_macros.h"
#include "server/rpc/convert_collection.h"
#include "server/rpc/convert_mesh.h"
#include "server/rpc/convert_shape.h"
#include "server/rpc/convert_upload.h"
#include "server/rpc/resource_name.h"
#include "server/rpc/status.h"

namespace argmesh {
namespace {

constexpr size_t kMaxKeyBytes = 1024;

v1::IngestShapesResponse CreditOf(int64_t items, int64_t bytes) {
  v1::IngestShapesResponse message;
  message.mutable_credit()->set_items(static_cast<int32_t>(items));
  message.mutable_credit()->set_bytes(bytes);
  return message;
}

absl::Status Incomplete(int64_t announced, int64_t received) {
  return MakeError(
      ErrorReason::kMeshSizeMismatch,
      absl::StrFormat("%d of %d announced bytes came", received, announced),
      {{"announced", absl::StrFormat("%d", announced)},
       {"received", absl::StrFormat("%d", received)}});
}

}  // namespace

IngestReactor::IngestReactor(ServiceEnvironment& environment,
                             grpc::CallbackServerContext* context)
    : ReadingReactor(environment, context, "IngestService.IngestShapes") {}

void IngestReactor::Begin() {
  if (AdmitTo(environment().ingests)) StartNextRead();
}

// --- reading -----------------------------------------------------------------

void IngestReactor::Received(std::shared_ptr<v1::IngestShapesRequest> request) {
  pace_.Moved(static_cast<int64_t>(request->ByteSizeLong()));
  RunPatiently(WorkClass::kQuick, [this, request] { Step(*request); });
}

void IngestReactor::Step(v1::IngestShapesRequest& request) {
  absl::Status status;
  if (request.has_hello() != collection_.empty()) {
    status = StreamOrderInvalid("hello comes first and once");
  } else if (request.has_hello()) {
    status = Hello(request.hello());
  } else if (request.has_item()) {
    status = BeginItem(request.item());
  } else if (request.has_chunk() && current_ != nullptr) {
    TakeChunk(request.chunk());
  } else {
    status = StreamOrderInvalid("a chunk without an item");
  }
  if (status.ok()) {
    StartNextRead();
  } else {
    StopReading(status);
  }
}

absl::Status IngestReactor::Hello(const v1::IngestHello& hello) {
  ARGMESH_RETURN_IF_ERROR(OpenCollection(hello));
  const ServiceLimits& limits = environment().limits;
  Send(CreditOf(limits.ingest_credit_items, limits.ingest_credit_bytes));
  return absl::OkStatus();
}

absl::Status IngestReactor::OpenCollection(const v1::IngestHello& hello) {
  ARGMESH_ASSIGN_OR_RETURN(
      std::string id,
      ParseCollectionName("hello.collection", hello.collection()));
  absl::StatusOr<CollectionRecord> record = engine().GetCollection(id);
  if (!record.ok() && hello.create_if_absent() &&
      ReasonOf(record.status()) == ErrorReason::kCollectionNotFound) {
    NewCollection spec;
    spec.id = id;
    ARGMESH_ASSIGN_OR_RETURN(spec.settings,
                             FromProto("hello.settings", hello.settings()));
    record = engine().CreateCollection(spec);
    if (ReasonOf(record.status()) == ErrorReason::kCollectionExists) {
      record = engine().GetCollection(id);  // another stream was faster
    }
  }
  ARGMESH_RETURN_IF_ERROR(record.status());
  if (hello.create_if_absent() && hello.has_settings()) {
    ARGMESH_ASSIGN_OR_RETURN(const CollectionSettings wanted,
                             FromProto("hello.settings", hello.settings()));
    if (!(wanted == record->settings)) {
      return FieldInvalid("hello.settings",
                          "the collection exists with other settings");
    }
  }
  collection_ = std::move(id);
  return absl::OkStatus();
}

absl::Status IngestReactor::BeginItem(const v1::IngestItem& item) {
  CloseIncompleteItem();
  ARGMESH_RETURN_IF_ERROR(TakeCredit(item));
  current_ = std::make_shared<Item>();
  current_->key = item.key();
  current_->shape_id = item.shape_id();
  current_->credit_bytes = std::max<int64_t>(item.size_bytes(), 0);
  if (const absl::Status started = StartItem(item); !started.ok()) {
    SendResult(*current_, started);
  }
  return absl::OkStatus();
}

absl::Status IngestReactor::TakeCredit(const v1::IngestItem& item) {
  const std::lock_guard lock(scope().mutex());
  if (draining_) return ServerDraining();
  if (credit_items_ < 1 || credit_bytes_ < 1) {
    return MakeError(ErrorReason::kCreditExceeded,
                     absl::StrFormat("an item was begun with credit for %d "
                                     "items and %d bytes left",
                                     credit_items_, credit_bytes_));
  }
  if (item.key().size() > kMaxKeyBytes) {
    return FieldInvalid("item.key",
                        absl::StrFormat("%d bytes, the limit is %d",
                                        item.key().size(), kMaxKeyBytes));
  }
  --credit_items_;
  credit_bytes_ -= std::max<int64_t>(item.size_bytes(), 0);
  ++open_items_;
  return absl::OkStatus();
}

absl::Status IngestReactor::StartItem(const v1::IngestItem& item) {
  ARGMESH_ASSIGN_OR_RETURN(AnnouncedShape announced,
                           FromProto(collection_, item));
  ARGMESH_ASSIGN_OR_RETURN(current_->upload,
                           engine().StartUpload(announced.upload));
  current_->shape = std::move(announced.shape);
  current_->shape.request.principal = scope().caller().principal;
  current_->size_bytes = announced.upload.size_bytes;
  return absl::OkStatus();
}

void IngestReactor::TakeChunk(const std::string& chunk) {
  if (current_->upload == nullptr) return;
  absl::Status status = current_->upload->Append(chunk);
  if (status.ok()) {
    if (current_->upload->received_bytes() < current_->size_bytes) return;
    absl::StatusOr<std::unique_ptr<StagedMesh>> mesh =
        current_->upload->Finish();
    if (mesh.ok()) {
      current_->mesh = *std::move(mesh);
      Compute(std::exchange(current_, nullptr));
      return;
    }
    status = mesh.status();
  }
  current_->upload.reset();
  SendResult(*current_, status);
}

void IngestReactor::CloseIncompleteItem() {
  if (current_ != nullptr && current_->upload != nullptr) {
    const int64_t received = current_->upload->received_bytes();
    current_->upload.reset();
    SendResult(*current_, Incomplete(current_->size_bytes, received));
  }
  current_.reset();
}

void IngestReactor::StopReading(const absl::Status& status) {
  CloseIncompleteItem();
  {
    const std::lock_guard lock(scope().mutex());
    reads_ended_ = true;
    end_ = status;
  }
  FinishWhenDone();
}

void IngestReactor::ReadsEnded() {
  // A client that went away looks the same; Cancelled() does not wait for it.
  StopReading(collection_.empty()
                  ? StreamOrderInvalid("the stream ended before its hello")
                  : absl::OkStatus());
}

// --- computing ---------------------------------------------------------------

void IngestReactor::Compute(ItemPtr item) {
  {
    const std::lock_guard lock(scope().mutex());
    ready_.push_back(std::move(item));
  }
  ComputeNext();
}

void IngestReactor::ComputeNext() {
  const int side_by_side =
      std::max(1, engine().pool().Load(WorkClass::kCompute).threads);
  ItemPtr item;
  {
    const std::lock_guard lock(scope().mutex());
    if (ready_.empty() || computing_ >= side_by_side) return;
    item = std::move(ready_.front());
    ready_.pop_front();
    ++computing_;
  }
  RunPatiently(WorkClass::kCompute, [this, item = std::move(item)] {
    const absl::StatusOr<AddedShape> added = Add(*item);
    {
      const std::lock_guard lock(scope().mutex());
      --computing_;
    }
    SendResult(*item, added);
    ComputeNext();
  });
}

absl::StatusOr<AddedShape> IngestReactor::Add(Item& item) {
  try {
    return engine().AddShape(item.shape, std::move(item.mesh), stop());
  } catch (...) {
    // The other items have nothing to do with it.
    return CallScope::CurrentException();
  }
}

void IngestReactor::SendResult(const Item& item,
                               const absl::StatusOr<AddedShape>& added) {
  v1::IngestShapesResponse message;
  v1::IngestItemResult& result = *message.mutable_result();
  result.set_key(item.key);
  google::rpc::Status report =
      scope().ReportItem({collection_, item.shape_id}, added.status());
  if (added.ok()) {
    *result.mutable_shape() = ToProto(added->record);
    result.set_already_stored(added->already_stored);
  } else {
    *result.mutable_error() = std::move(report);
  }
  {
    const std::lock_guard lock(scope().mutex());
    --open_items_;
    outbox_.push_back(std::move(message));
    if (!reads_ended_ && !draining_) {
      outbox_.push_back(CreditOf(1, item.credit_bytes));
    }
    StartNextWrite();
  }
  FinishWhenDone();
}

// --- writing -----------------------------------------------------------------

void IngestReactor::Send(v1::IngestShapesResponse message) {
  const std::lock_guard lock(scope().mutex());
  outbox_.push_back(std::move(message));
  StartNextWrite();
}

void IngestReactor::StartNextWrite() {
  if (scope().finished() || outbox_.empty() || writing_.pending()) return;
  message_ = std::move(outbox_.front());
  outbox_.pop_front();
  if (message_.has_credit()) {
    // Not before: what the client does not take it gets no credit for, and the
    // outbox holds no more than the credit allows.
    credit_items_ += message_.credit().items();
    credit_bytes_ += message_.credit().bytes();
  }
  writing_.Begin();
  StartWrite(&message_);
}

void IngestReactor::OnWriteDone(bool ok) {
  Guard([&] {
    {
      const std::lock_guard lock(scope().mutex());
      writing_.End();
      pace_.Moved(static_cast<int64_t>(message_.ByteSizeLong()));
      if (ok) StartNextWrite();
    }
    if (ok) {
      FinishWhenDone();
    } else {
      scope().RequestStop();
      FinishOnce(absl::CancelledError("the client went away"));
    }
  });
}

void IngestReactor::FinishWhenDone() {
  absl::Status end;
  {
    const std::lock_guard lock(scope().mutex());
    const bool idle =
        open_items_ == 0 && outbox_.empty() && !writing_.pending();
    if (!idle || !(reads_ended_ || draining_)) return;
    end = reads_ended_ ? end_ : ServerDraining();
  }
  FinishOnce(end);
}

// --- from the registry -------------------------------------------------------

void IngestReactor::OnTick(absl::Time now) {
  ResubmitWaiting();
  const absl::Duration limit = environment().stream_idle_timeout();
  bool too_slow = false;
  {
    const std::lock_guard lock(scope().mutex());
    const bool writes = writing_.pending();
    const bool reads = Waits() && computing_ == 0 && ready_.empty();
    too_slow = pace_.Lag(now, reads || writes) > limit;
    // A write that nobody takes blocks the end of the call too: only a
    // cancellation gets through.
    if (writes && (too_slow || writing_.Lasted(now) > limit)) {
      scope().context()->TryCancel();
      return;
    }
  }
  if (too_slow) FinishOnce(StreamTooSlow(limit));
}

void IngestReactor::OnDrain(absl::Duration grace) {
  {
    const std::lock_guard lock(scope().mutex());
    draining_ = true;
    v1::IngestShapesResponse message;
    *message.mutable_go_away()->mutable_grace() = ToDuration(grace);
    outbox_.push_back(std::move(message));
    StartNextWrite();
  }
  FinishWhenDone();
}

}  // namespace argmesh
