#include "server/rpc/convert_upload.h"

#include <string>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"
#include "server/rpc/convert_mesh.h"
#include "server/rpc/convert_shape.h"
#include "server/rpc/resource_name.h"
#include "server/rpc/status.h"

namespace argmesh {
namespace {

// Fields of one message are named below `prefix`: "", "header." or "item.".
template <typename Message>
absl::Status CopyCommon(const std::string& prefix, const Message& message,
                        NewShape* out) {
  ARGMESH_RETURN_IF_ERROR(
      CheckResourceId(prefix + "shape_id", message.shape_id()));
  out->id = message.shape_id();
  ARGMESH_ASSIGN_OR_RETURN(out->if_exists,
                           FromProto(prefix + "existing_shape_policy",
                                     message.existing_shape_policy()));
  out->etag = message.etag();
  out->request.request_id = message.request_id();
  return absl::OkStatus();
}

template <typename Message>
absl::Status CopyAnnouncement(const std::string& prefix, const Message& message,
                              AnnouncedShape* out) {
  ARGMESH_RETURN_IF_ERROR(CopyCommon(prefix, message, &out->shape));
  ARGMESH_ASSIGN_OR_RETURN(out->shape.format,
                           FromProto(prefix + "format", message.format()));
  ARGMESH_ASSIGN_OR_RETURN(
      out->upload,
      ParseAnnouncement(prefix, message.size_bytes(), message.sha256()));
  out->shape.sha256 = out->upload.sha256;
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<UploadAnnouncement> ParseAnnouncement(
    const std::string& prefix, int64_t size_bytes, const std::string& sha256) {
  UploadAnnouncement upload;
  ARGMESH_ASSIGN_OR_RETURN(upload.sha256,
                           ParseSha256(prefix + "sha256", sha256));
  if (size_bytes <= 0) {
    return FieldInvalid(
        prefix + "size_bytes",
        absl::StrFormat("%d, but a mesh has bytes", size_bytes));
  }
  upload.size_bytes = size_bytes;
  return upload;
}

absl::StatusOr<NewShape> FromProto(const v1::CreateShapeRequest& request) {
  NewShape shape;
  ARGMESH_ASSIGN_OR_RETURN(shape.collection,
                           ParseCollectionName("parent", request.parent()));
  ARGMESH_RETURN_IF_ERROR(CopyCommon("", request, &shape));
  ARGMESH_ASSIGN_OR_RETURN(shape.format,
                           FromProto("mesh.format", request.mesh().format()));
  if (request.mesh().data().empty()) return FieldRequired("mesh.data");
  CopyOwnerFields(request.shape(), &shape);
  return shape;
}

absl::StatusOr<AnnouncedShape> FromProto(const v1::UploadShapeHeader& header) {
  AnnouncedShape announced;
  ARGMESH_ASSIGN_OR_RETURN(
      announced.shape.collection,
      ParseCollectionName("header.parent", header.parent()));
  ARGMESH_RETURN_IF_ERROR(CopyAnnouncement("header.", header, &announced));
  CopyOwnerFields(header.shape(), &announced.shape);
  return announced;
}

absl::StatusOr<AnnouncedShape> FromProto(std::string_view collection,
                                         const v1::IngestItem& item) {
  AnnouncedShape announced;
  announced.shape.collection = std::string(collection);
  ARGMESH_RETURN_IF_ERROR(CopyAnnouncement("item.", item, &announced));
  announced.shape.display_name = item.display_name();
  announced.shape.source_uri = item.source_uri();
  for (const auto& [key, value] : item.metadata()) {
    announced.shape.metadata.emplace(key, value);
  }
  return announced;
}

}  // namespace argmesh
