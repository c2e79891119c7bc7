// New shapes as shape_service.proto and ingest_service.proto announce them.
#ifndef ARGMESH_SERVER_RPC_CONVERT_UPLOAD_H_
#define ARGMESH_SERVER_RPC_CONVERT_UPLOAD_H_

#include <cstdint>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "argmesh/v1/ingest_service.pb.h"
#include "argmesh/v1/shape_service.pb.h"
#include "server/engine/mesh_upload.h"
#include "server/engine/shape_requests.h"

namespace argmesh {

// NAME_INVALID, FIELD_REQUIRED, FIELD_INVALID; the engine checks the rest.
absl::StatusOr<NewShape> FromProto(const v1::CreateShapeRequest& request);

// `prefix` is where the fields are: "header." or "item.".
absl::StatusOr<UploadAnnouncement> ParseAnnouncement(const std::string& prefix,
                                                     int64_t size_bytes,
                                                     const std::string& sha256);

struct AnnouncedShape {
  NewShape shape;
  UploadAnnouncement upload;
};
absl::StatusOr<AnnouncedShape> FromProto(const v1::UploadShapeHeader& header);
absl::StatusOr<AnnouncedShape> FromProto(std::string_view collection,
                                         const v1::IngestItem& item);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_CONVERT_UPLOAD_H_
