// Snapshots, checks and operations of Client.
#include <utility>

#include "absl/strings/str_format.h"
#include "client/client.h"
#include "client/client_parts.h"
#include "client/operation_wait.h"
#include "core/base/sha256.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

using google::longrunning::Operation;

}  // namespace

absl::StatusOr<v1::Snapshot> Client::CreateSnapshot(std::string_view id) {
  v1::CreateSnapshotRequest request;
  request.set_snapshot_id(std::string(id));
  ARGMESH_ASSIGN_OR_RETURN(
      Operation operation,
      parts_->Call<Operation>(
          Repeat::kNever, [&](grpc::ClientContext* context, auto* response) {
            return parts_->admin->CreateSnapshot(context, request, response);
          }));
  return Await<v1::Snapshot>(*parts_, std::move(operation));
}

absl::StatusOr<v1::VerifyStorageResponse> Client::VerifyStorage(
    const std::string& collection) {
  v1::VerifyStorageRequest request;
  request.set_collection(collection);
  ARGMESH_ASSIGN_OR_RETURN(
      Operation operation,
      parts_->Call<Operation>(
          Repeat::kSafe, [&](grpc::ClientContext* context, auto* response) {
            return parts_->admin->VerifyStorage(context, request, response);
          }));
  return Await<v1::VerifyStorageResponse>(*parts_, std::move(operation));
}

absl::StatusOr<std::vector<v1::Snapshot>> Client::ListSnapshots() {
  std::vector<v1::Snapshot> snapshots;
  v1::ListSnapshotsRequest request;
  do {
    ARGMESH_ASSIGN_OR_RETURN(
        const auto page,
        parts_->Call<v1::ListSnapshotsResponse>(
            Repeat::kSafe, [&](grpc::ClientContext* context, auto* response) {
              return parts_->admin->ListSnapshots(context, request, response);
            }));
    snapshots.insert(snapshots.end(), page.snapshots().begin(),
                     page.snapshots().end());
    request.set_page_token(page.next_page_token());
  } while (!request.page_token().empty());
  return snapshots;
}

absl::StatusOr<std::vector<Operation>> Client::ListOperations() {
  std::vector<Operation> operations;
  google::longrunning::ListOperationsRequest request;
  do {
    ARGMESH_ASSIGN_OR_RETURN(
        const auto page,
        parts_->Call<google::longrunning::ListOperationsResponse>(
            Repeat::kSafe, [&](grpc::ClientContext* context, auto* response) {
              return parts_->operations->ListOperations(context, request,
                                                        response);
            }));
    operations.insert(operations.end(), page.operations().begin(),
                      page.operations().end());
    request.set_page_token(page.next_page_token());
  } while (!request.page_token().empty());
  return operations;
}

absl::Status Client::CancelOperation(const std::string& name) {
  return RequestCancel(*parts_, name);
}

absl::Status Client::DeleteSnapshot(std::string_view name) {
  v1::DeleteSnapshotRequest request;
  request.set_name(std::string(name));
  return parts_
      ->Call<v1::DeleteSnapshotResponse>(
          Repeat::kNever,
          [&](grpc::ClientContext* context, auto* response) {
            return parts_->admin->DeleteSnapshot(context, request, response);
          })
      .status();
}

absl::StatusOr<v1::Snapshot> Client::DownloadSnapshot(
    std::string_view name,
    const std::function<absl::Status(std::string_view)>& write) {
  v1::DownloadSnapshotRequest request;
  request.set_name(std::string(name));
  grpc::ClientContext context;
  // However large it is: the server cuts a stream that stands still.
  parts_->Prepare(absl::InfiniteFuture(), context);
  const auto reader = parts_->admin->DownloadSnapshot(&context, request);
  v1::Snapshot snapshot;
  Sha256Hasher hasher;
  int64_t size = 0;
  absl::Status written;
  v1::DownloadSnapshotResponse response;
  while (reader->Read(&response)) {
    if (response.has_snapshot()) snapshot = response.snapshot();
    hasher.Update(response.chunk());
    size += static_cast<int64_t>(response.chunk().size());
    written = write(response.chunk());
    if (!written.ok()) {
      context.TryCancel();
      break;
    }
  }
  const grpc::Status status = reader->Finish();
  ARGMESH_RETURN_IF_ERROR(written);
  if (!status.ok()) return parts_->Explain(status);
  if (size != snapshot.size_bytes() ||
      ToHex(hasher.Finish()) != snapshot.sha256()) {
    return absl::DataLossError(absl::StrFormat(
        "%s came with other bytes than the server has", std::string(name)));
  }
  return snapshot;
}

}  // namespace argmesh
