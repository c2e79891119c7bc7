#include "server/rpc/download_reactor.h"

#include <utility>

#include "absl/time/clock.h"
#include "core/base/status_macros.h"
#include "server/rpc/convert_mesh.h"
#include "server/rpc/resource_name.h"

namespace argmesh {
namespace {

constexpr int64_t kChunkBytes = 256 << 10;

}  // namespace

DownloadReactor::DownloadReactor(ServiceEnvironment& environment,
                                 grpc::CallbackServerContext* context,
                                 const v1::DownloadMeshRequest* request)
    : GuardedReactor(environment, context, request,
                     "ShapeService.DownloadMesh"),
      request_(request) {}

void DownloadReactor::Begin() {
  Run(WorkClass::kQuick, [this] {
    if (const absl::Status opened = Open(); !opened.ok()) {
      FinishOnce(opened);
    } else {
      SendResponse();
    }
  });
}

absl::Status DownloadReactor::Open() {
  ARGMESH_ASSIGN_OR_RETURN(const ShapeRef shape,
                           ParseShapeName("name", request_->name()));
  ARGMESH_ASSIGN_OR_RETURN(ShapeRecord record, engine().GetShape(shape));
  // A shape may be replaced between the two reads: the header must be that of
  // the bytes.
  while (true) {
    ARGMESH_RETURN_IF_ERROR(stop().Check());
    ARGMESH_ASSIGN_OR_RETURN(reader_, engine().OpenMesh(shape));
    ARGMESH_ASSIGN_OR_RETURN(ShapeRecord after, engine().GetShape(shape));
    if (after.generation == record.generation) break;
    record = std::move(after);
  }
  v1::DownloadMeshHeader& header = *response_.mutable_header();
  header.set_format(ToProto(record.format));
  header.set_size_bytes(reader_->size_bytes());
  header.set_sha256(ToHex(record.sha256));
  return absl::OkStatus();
}

absl::StatusOr<bool> DownloadReactor::ReadChunk() {
  ARGMESH_ASSIGN_OR_RETURN(std::string chunk, reader_->Read(kChunkBytes));
  if (chunk.empty()) return false;
  response_.set_chunk(std::move(chunk));
  return true;
}

void DownloadReactor::SendResponse() {
  const std::lock_guard lock(scope().mutex());
  if (scope().finished()) return;
  writing_since_ = absl::Now();
  StartWrite(&response_);
}

void DownloadReactor::OnWriteDone(bool ok) {
  Guard([&] {
    {
      const std::lock_guard lock(scope().mutex());
      writing_since_ = absl::InfiniteFuture();
    }
    if (!ok) {
      FinishOnce(absl::CancelledError("the client went away"));
      return;
    }
    RunPatiently(WorkClass::kQuick, [this] {
      const absl::StatusOr<bool> more = ReadChunk();
      if (more.ok() && *more) {
        SendResponse();
      } else {
        FinishOnce(more.status());
      }
    });
  });
}

void DownloadReactor::OnTick(absl::Time now) {
  ResubmitWaiting();
  const std::lock_guard lock(scope().mutex());
  // A write that nobody takes blocks the end of the call too: only a
  // cancellation gets through.
  if (now - writing_since_ > environment().stream_idle_timeout()) {
    scope().context()->TryCancel();
  }
}

}  // namespace argmesh
