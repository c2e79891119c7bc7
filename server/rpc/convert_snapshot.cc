#include "server/rpc/convert_snapshot.h"

#include "server/rpc/convert_mesh.h"
#include "server/rpc/resource_name.h"

namespace argmesh {

v1::Snapshot ToProto(const SnapshotRecord& record) {
  v1::Snapshot snapshot;
  snapshot.set_name(SnapshotName(record.id));
  *snapshot.mutable_create_time() = ToTimestamp(record.create_time);
  snapshot.set_size_bytes(record.size_bytes);
  snapshot.set_sha256(ToHex(record.sha256));
  return snapshot;
}

v1::VerifyStorageResponse ToProto(const StorageReport& report) {
  v1::VerifyStorageResponse response;
  response.set_shapes(report.shapes);
  response.set_checksums(report.checksums);
  response.set_meshes(report.meshes);
  response.set_mesh_bytes(report.mesh_bytes);
  response.set_findings(report.findings);
  for (const std::string& finding : report.first_findings) {
    response.add_first_findings(finding);
  }
  return response;
}

}  // namespace argmesh
