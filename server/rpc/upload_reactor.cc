#include "server/rpc/upload_reactor.h"

#include <utility>

#include "core/base/status_macros.h"
#include "server/rpc/convert_shape.h"
#include "server/rpc/convert_upload.h"

namespace argmesh {

UploadReactor::UploadReactor(ServiceEnvironment& environment,
                             grpc::CallbackServerContext* context)
    : AnsweringReactor(
          std::make_unique<v1::Shape>(), environment, context,
          MeshStreamPlan{"ShapeService.UploadShape", WorkClass::kCompute,
                         environment.uploads}) {}

absl::StatusOr<UploadAnnouncement> UploadReactor::Announced(
    const v1::UploadShapeRequest& first) {
  ARGMESH_ASSIGN_OR_RETURN(AnnouncedShape announced, FromProto(first.header()));
  // Before gigabytes come for a collection that is not there.
  ARGMESH_RETURN_IF_ERROR(
      engine().GetCollection(announced.shape.collection).status());
  shape_ = std::move(announced.shape);
  shape_.request.principal = scope().caller().principal;
  return announced.upload;
}

absl::Status UploadReactor::Take(std::unique_ptr<StagedMesh> mesh) {
  ARGMESH_ASSIGN_OR_RETURN(const AddedShape added,
                           engine().AddShape(shape_, std::move(mesh), stop()));
  response() = ToProto(added.record);
  FinishOnce(absl::OkStatus());
  return absl::OkStatus();
}

}  // namespace argmesh
