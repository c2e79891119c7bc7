#include "server/rpc/upload_reactor.h"

#include <utility>

#include "core/base/status_macros.h"
#include "server/rpc/convert_shape.h"
#include "server/rpc/convert_upload.h"

namespace argmesh {

UploadReactor::UploadReactor(ServiceEnvironment& environment,
                             grpc::CallbackServerContext* context,
                             v1::Shape* response)
    : ReadingReactor(environment, context, nullptr, "ShapeService.UploadShape"),
      response_(response) {}

void UploadReactor::Begin() {
  if (AdmitTo(environment().uploads)) StartNextRead();
}

void UploadReactor::Received(v1::UploadShapeRequest& request) {
  const bool expected = request.has_header()  ? upload_ == nullptr
                        : request.has_chunk() ? upload_ != nullptr
                                              : false;
  if (!expected) {
    FinishOnce(StreamOrderInvalid("an upload is one header, then chunks"));
    return;
  }
  RunPatiently(WorkClass::kQuick, [this, &request] {
    const absl::Status taken = request.has_header()
                                   ? StartUpload(request.header())
                                   : upload_->Append(request.chunk());
    if (taken.ok()) {
      StartNextRead();
    } else {
      FinishOnce(taken);
    }
  });
}

absl::Status UploadReactor::StartUpload(const v1::UploadShapeHeader& header) {
  ARGMESH_ASSIGN_OR_RETURN(AnnouncedShape announced, FromProto(header));
  // Before gigabytes come for a collection that is not there.
  ARGMESH_RETURN_IF_ERROR(
      engine().GetCollection(announced.shape.collection).status());
  ARGMESH_ASSIGN_OR_RETURN(upload_, engine().StartUpload(announced.upload));
  shape_ = std::move(announced.shape);
  shape_.request.principal = scope().caller().principal;
  return absl::OkStatus();
}

void UploadReactor::ReadsEnded() {
  if (upload_ == nullptr) {
    FinishOnce(StreamOrderInvalid("the stream ended before its header"));
    return;
  }
  RunPatiently(WorkClass::kCompute, [this] { FinishOnce(AddShape()); });
}

absl::Status UploadReactor::AddShape() {
  ARGMESH_ASSIGN_OR_RETURN(std::unique_ptr<StagedMesh> mesh, upload_->Finish());
  ARGMESH_ASSIGN_OR_RETURN(const AddedShape added,
                           engine().AddShape(shape_, std::move(mesh), stop()));
  *response_ = ToProto(added.record);
  return absl::OkStatus();
}

void UploadReactor::OnTick(absl::Time now) {
  ResubmitWaiting();
  const absl::Duration limit = environment().stream_idle_timeout();
  if (Silence(now) > limit) FinishOnce(StreamIdle(limit));
}

}  // namespace argmesh
