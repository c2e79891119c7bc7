#include "server/rpc/download_reactor.h"

#include <utility>

#include "core/base/status_macros.h"
#include "server/rpc/convert_mesh.h"
#include "server/rpc/resource_name.h"

namespace argmesh {

DownloadReactor::DownloadReactor(ServiceEnvironment& environment,
                                 grpc::CallbackServerContext* context)
    : WritingReactor(environment, context, "ShapeService.DownloadMesh") {}

void DownloadReactor::Requested(
    std::shared_ptr<const v1::DownloadMeshRequest> request) {
  name_ = request->name();
  Run(WorkClass::kQuick, [this] { SendNext(); });
}

absl::Status DownloadReactor::Open(v1::DownloadMeshResponse& first) {
  ARGMESH_ASSIGN_OR_RETURN(const ShapeRef shape, ParseShapeName("name", name_));
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
  v1::DownloadMeshHeader& header = *first.mutable_header();
  header.set_format(ToProto(record.format));
  header.set_size_bytes(reader_->size_bytes());
  header.set_sha256(ToHex(record.sha256));
  return absl::OkStatus();
}

absl::StatusOr<bool> DownloadReactor::Continue(v1::DownloadMeshResponse& next) {
  if (reader_ == nullptr) {
    ARGMESH_RETURN_IF_ERROR(Open(next));
    return true;
  }
  ARGMESH_ASSIGN_OR_RETURN(std::string chunk,
                           reader_->Read(kDownloadChunkBytes));
  if (chunk.empty()) return false;
  next.set_chunk(std::move(chunk));
  return true;
}

}  // namespace argmesh
