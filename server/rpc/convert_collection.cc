#include "server/rpc/convert_collection.h"

#include <string>

#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "server/rpc/convert_mesh.h"
#include "server/rpc/resource_name.h"
#include "server/rpc/status.h"

namespace argmesh {
namespace {

absl::StatusOr<DecompositionKind> KindFromProto(std::string_view field,
                                                v1::DecompositionKind kind,
                                                DecompositionKind unset) {
  switch (kind) {
    case v1::DECOMPOSITION_KIND_UNSPECIFIED:
      return unset;
    case v1::DECOMPOSITION_KIND_BIHARMONIC:
      return DecompositionKind::kBiharmonic;
    case v1::DECOMPOSITION_KIND_NORMAL_CURVATURE:
      return DecompositionKind::kNormalCurvature;
    case v1::DECOMPOSITION_KIND_VORONOI:
      return DecompositionKind::kVoronoi;
    default:
      return FieldInvalid(field,
                          absl::StrFormat("%d cannot be a collection's setting",
                                          static_cast<int>(kind)));
  }
}

}  // namespace

absl::StatusOr<CollectionSettings> FromProto(
    std::string_view field, const v1::CollectionSettings& settings,
    const CollectionSettings& unset) {
  CollectionSettings out = unset;
  ARGMESH_ASSIGN_OR_RETURN(
      out.decomposition,
      KindFromProto(std::string(field) + ".decomposition",
                    settings.decomposition(), unset.decomposition));
  if (settings.vertex_budget() != 0) {
    out.vertex_budget = settings.vertex_budget();
  }
  if (settings.has_uniform_cells()) {
    out.uniform_cells = settings.uniform_cells();
  }
  if (settings.has_store_meshes()) out.store_meshes = settings.store_meshes();
  return out;
}

absl::StatusOr<std::vector<MetadataKey>> FromProto(
    std::string_view field,
    const google::protobuf::RepeatedPtrField<v1::MetadataKey>& keys) {
  std::vector<MetadataKey> out;
  for (const v1::MetadataKey& key : keys) {
    if (!v1::MetadataType_IsValid(key.type()) ||
        key.type() == v1::METADATA_TYPE_UNSPECIFIED) {
      return FieldInvalid(
          field, absl::StrFormat("%d is no type of metadata", key.type()));
    }
    // The numbers are the same.
    out.push_back({key.key(), static_cast<MetadataType>(key.type())});
  }
  return out;
}

v1::CollectionSettings ToProto(const CollectionSettings& settings) {
  v1::CollectionSettings out;
  out.set_decomposition(ToProto(settings.decomposition));
  out.set_vertex_budget(settings.vertex_budget);
  out.set_uniform_cells(settings.uniform_cells);
  out.set_store_meshes(settings.store_meshes);
  return out;
}

v1::Collection ToProto(const CollectionRecord& record) {
  v1::Collection out;
  out.set_name(CollectionName(record.id));
  out.set_uid(record.uid);
  out.set_display_name(record.display_name);
  *out.mutable_settings() = ToProto(record.settings);
  out.set_shape_count(record.shape_count);
  out.set_generation(record.generation);
  *out.mutable_create_time() = ToTimestamp(record.create_time);
  *out.mutable_update_time() = ToTimestamp(record.update_time);
  out.set_etag(CollectionEtag(record));
  out.set_graph_version(record.graph_version);
  for (const MetadataKey& key : record.metadata_keys) {
    v1::MetadataKey& added = *out.add_metadata_keys();
    added.set_key(key.key);
    added.set_type(static_cast<v1::MetadataType>(key.type));
  }
  return out;
}

v1::DecompositionKind ToProto(DecompositionKind kind) {
  switch (kind) {
    case DecompositionKind::kBiharmonic:
      return v1::DECOMPOSITION_KIND_BIHARMONIC;
    case DecompositionKind::kNormalCurvature:
      return v1::DECOMPOSITION_KIND_NORMAL_CURVATURE;
    case DecompositionKind::kVoronoi:
      return v1::DECOMPOSITION_KIND_VORONOI;
    case DecompositionKind::kGiven:
      return v1::DECOMPOSITION_KIND_GIVEN;
  }
  return v1::DECOMPOSITION_KIND_UNSPECIFIED;
}

}  // namespace argmesh
