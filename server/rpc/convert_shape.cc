#include "server/rpc/convert_shape.h"

#include "absl/strings/str_format.h"
#include "server/engine/error_reason.h"
#include "server/rpc/convert_mesh.h"
#include "server/rpc/resource_name.h"
#include "server/rpc/status.h"

namespace argmesh {
namespace {

v1::ShapeState StateToProto(ShapeState state) {
  switch (state) {
    case ShapeState::kPending:
      return v1::SHAPE_STATE_PENDING;
    case ShapeState::kProcessing:
      return v1::SHAPE_STATE_PROCESSING;
    case ShapeState::kActive:
      return v1::SHAPE_STATE_ACTIVE;
    case ShapeState::kFailed:
      return v1::SHAPE_STATE_FAILED;
  }
  return v1::SHAPE_STATE_UNSPECIFIED;
}

v1::GraphSummary SummaryToProto(const GraphSummary& summary) {
  v1::GraphSummary out;
  out.set_version(summary.version);
  for (const GraphSummary::Level& level : summary.levels) {
    v1::LevelSummary& added = *out.add_levels();
    added.set_name(level.name);
    added.set_nodes(level.nodes);
    added.set_edges(level.edges);
  }
  out.set_modes(summary.modes);
  return out;
}

}  // namespace

v1::Shape ToProto(const ShapeRecord& record) {
  v1::Shape out;
  out.set_name(ShapeName(record.collection, record.id));
  out.set_uid(record.uid);
  out.set_display_name(record.display_name);
  out.set_source_uri(record.source_uri);
  for (const auto& [key, value] : record.metadata) {
    (*out.mutable_metadata())[key] = value;
  }
  out.set_state(StateToProto(record.state));
  v1::Mesh& mesh = *out.mutable_mesh();
  mesh.set_format(ToProto(record.format));
  mesh.set_size_bytes(record.size_bytes);
  mesh.set_sha256(ToHex(record.sha256));
  *mesh.mutable_report() = ToProto(record.report);
  mesh.set_stored(record.mesh_stored);
  if (record.state == ShapeState::kActive) {
    *out.mutable_graph() = SummaryToProto(record.graph);
  }
  *out.mutable_create_time() = ToTimestamp(record.create_time);
  *out.mutable_update_time() = ToTimestamp(record.update_time);
  out.set_etag(ShapeEtag(record));
  out.set_generation(record.generation);
  if (record.state == ShapeState::kFailed) {
    *out.mutable_error() =
        ToProtoStatus(MakeError(ErrorReason::kMeshDegenerate, record.error));
  }
  return out;
}

absl::StatusOr<IfExists> FromProto(std::string_view field,
                                   v1::ExistingShapePolicy policy) {
  switch (policy) {
    case v1::EXISTING_SHAPE_POLICY_UNSPECIFIED:
    case v1::EXISTING_SHAPE_POLICY_REFUSE:
      return IfExists::kFail;
    case v1::EXISTING_SHAPE_POLICY_ACCEPT_SAME_MESH:
      return IfExists::kReturnSame;
    case v1::EXISTING_SHAPE_POLICY_REPLACE:
      return IfExists::kReplace;
    default:
      return FieldInvalid(
          field, absl::StrFormat("%d is no policy", static_cast<int>(policy)));
  }
}

void CopyOwnerFields(const v1::Shape& shape, NewShape* out) {
  out->display_name = shape.display_name();
  out->source_uri = shape.source_uri();
  out->metadata.clear();
  for (const auto& [key, value] : shape.metadata()) {
    out->metadata.emplace(key, value);
  }
}

}  // namespace argmesh
