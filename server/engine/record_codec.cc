#include "server/engine/record_codec.h"

#include <algorithm>
#include <map>
#include <type_traits>
#include <vector>

#include "absl/strings/str_format.h"
#include "core/base/byte_reader.h"
#include "core/base/byte_writer.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr uint8_t kCodecVersion = 1;

// Writes fields in the order they are named.
class FieldWriter {
 public:
  FieldWriter() { bytes_.WriteU8(kCodecVersion); }

  void Field(int64_t value) { bytes_.WriteU64(static_cast<uint64_t>(value)); }
  void Field(int32_t value) { Field(int64_t{value}); }
  void Field(uint32_t value) { Field(int64_t{value}); }
  void Field(bool value) { bytes_.WriteU8(value ? 1 : 0); }
  void Field(double value) { bytes_.WriteF64(value); }
  void Field(const std::string& value) {
    bytes_.WriteU32(static_cast<uint32_t>(value.size()));
    bytes_.WriteBytes(value);
  }
  void Field(absl::Time value) { Field(absl::ToUnixMicros(value)); }
  template <typename E>
  requires std::is_enum_v<E>
  void Field(E value) { Field(static_cast<int32_t>(value)); }
  void Field(const Sha256Digest& value) {
    for (const uint8_t byte : value) bytes_.WriteU8(byte);
  }

  void Field(const std::map<std::string, std::string>& entries) {
    bytes_.WriteU32(static_cast<uint32_t>(entries.size()));
    for (const auto& [key, value] : entries) {
      Field(key);
      Field(value);
    }
  }
  template <typename T>
  void Resize(const std::vector<T>& items, size_t /*item_bytes*/) {
    bytes_.WriteU32(static_cast<uint32_t>(items.size()));
  }

  std::string TakeBytes() { return bytes_.TakeBytes(); }

 private:
  ByteWriter bytes_;
};

// Reads them back. After the first failure everything reads as it was and
// Finish tells.
class FieldReader {
 public:
  FieldReader(std::string_view bytes, std::string_view what)
      : reader_(bytes, what) {
    const uint8_t version = Keep(reader_.ReadU8(), uint8_t{0});
    if (status_.ok() && version != kCodecVersion) {
      status_ = absl::DataLossError(absl::StrFormat(
          "%s: version %d is not known", std::string(what), int{version}));
    }
  }

  void Field(int64_t& value) {
    value = static_cast<int64_t>(
        Keep(reader_.ReadU64(), static_cast<uint64_t>(value)));
  }
  void Field(int32_t& value) { value = Narrow(value); }
  void Field(uint32_t& value) { value = Narrow(value); }
  void Field(bool& value) { value = Keep(reader_.ReadU8(), uint8_t{0}) != 0; }
  void Field(double& value) { value = Keep(reader_.ReadF64(), value); }
  void Field(std::string& value) {
    const uint32_t size = Count(1);
    value = std::string(Keep(reader_.ReadBytes(size), std::string_view()));
  }
  void Field(absl::Time& value) {
    int64_t micros = 0;
    Field(micros);
    value = absl::FromUnixMicros(micros);
  }
  template <typename E>
  requires std::is_enum_v<E>
  void Field(E& value) { value = static_cast<E>(Narrow(int32_t{0})); }
  void Field(Sha256Digest& value) {
    const std::string_view bytes =
        Keep(reader_.ReadBytes(value.size()), std::string_view());
    std::copy(bytes.begin(), bytes.end(), value.begin());
  }

  void Field(std::map<std::string, std::string>& entries) {
    const uint32_t count = Count(8);
    for (uint32_t i = 0; i < count && status_.ok(); ++i) {
      std::string key;
      Field(key);
      Field(entries[key]);
    }
  }
  // `item_bytes` is the least that an item takes.
  template <typename T>
  void Resize(std::vector<T>& items, size_t item_bytes) {
    items.resize(Count(item_bytes));
  }

  bool at_end() const { return reader_.remaining() == 0; }

  absl::Status Finish() {
    if (status_.ok()) status_ = reader_.ExpectEnd();
    return status_;
  }

 private:
  uint32_t Count(size_t item_bytes) {
    return Keep(reader_.ReadCount(item_bytes), uint32_t{0});
  }
  template <typename T>
  T Keep(absl::StatusOr<T> read, T fallback) {
    if (!status_.ok()) return fallback;
    if (!read.ok()) {
      status_ = read.status();
      return fallback;
    }
    return *read;
  }
  template <typename T>
  T Narrow(T fallback) {
    int64_t wide = fallback;
    Field(wide);
    if (wide != static_cast<int64_t>(static_cast<T>(wide))) {
      if (status_.ok()) status_ = absl::DataLossError("number out of range");
      return fallback;
    }
    return static_cast<T>(wide);
  }

  ByteReader reader_;
  absl::Status status_;
};

// One list of fields for each record serves both directions; T is const when
// it is written.
template <typename A, typename T>
void VisitSettings(A& a, T& settings) {
  a.Field(settings.decomposition);
  a.Field(settings.vertex_budget);
  a.Field(settings.uniform_cells);
  a.Field(settings.store_meshes);
}

template <typename A, typename T>
void VisitKeys(A& a, T& keys) {
  constexpr size_t kKeyBytes = 12;
  a.Resize(keys, kKeyBytes);
  for (auto& key : keys) {
    a.Field(key.key);
    a.Field(key.type);
  }
}

template <typename A, typename T>
void VisitReport(A& a, T& report) {
  a.Field(report.vertices);
  a.Field(report.faces);
  a.Field(report.components);
  a.Field(report.boundary_edges);
  a.Field(report.nonmanifold_edges);
  a.Field(report.nonmanifold_vertices);
  a.Field(report.unused_vertices);
  a.Field(report.area);
  for (auto& value : report.bounding_box_min) a.Field(value);
  for (auto& value : report.bounding_box_max) a.Field(value);
  a.Field(report.euler_characteristic);
  a.Field(report.welded_vertices);
  a.Field(report.degenerate_faces_dropped);
  a.Field(report.duplicate_faces_dropped);
  a.Field(report.faces_flipped);
  a.Field(report.vertices_split);
  a.Field(report.sample_vertices);
  a.Field(report.smoothed);
}

template <typename A, typename T>
void VisitSummary(A& a, T& graph) {
  constexpr size_t kLevelBytes = 20;
  a.Field(graph.version);
  a.Resize(graph.levels, kLevelBytes);
  for (auto& level : graph.levels) {
    a.Field(level.name);
    a.Field(level.nodes);
    a.Field(level.edges);
  }
  a.Field(graph.modes);
}

template <typename A, typename T>
void VisitShape(A& a, T& record) {
  a.Field(record.collection);
  a.Field(record.id);
  a.Field(record.uid);
  a.Field(record.display_name);
  a.Field(record.source_uri);
  a.Field(record.metadata);
  a.Field(record.state);
  a.Field(record.error);
  a.Field(record.sha256);
  a.Field(record.size_bytes);
  a.Field(record.format);
  a.Field(record.mesh_stored);
  a.Field(record.generation);
  a.Field(record.create_time);
  a.Field(record.update_time);
  VisitReport(a, record.report);
  VisitSummary(a, record.graph);
}

template <typename A, typename T>
void VisitCollection(A& a, T& record) {
  a.Field(record.id);
  a.Field(record.uid);
  a.Field(record.display_name);
  VisitSettings(a, record.settings);
  a.Field(record.graph_version);
  a.Field(record.generation);
  a.Field(record.shape_count);
  a.Field(record.revision);
  a.Field(record.create_time);
  a.Field(record.update_time);
}

}  // namespace

std::string SerializeCollectionSettings(const CollectionSettings& settings) {
  FieldWriter writer;
  VisitSettings(writer, settings);
  return writer.TakeBytes();
}

absl::StatusOr<CollectionSettings> ParseCollectionSettings(
    std::string_view bytes) {
  FieldReader reader(bytes, "collection settings");
  CollectionSettings settings;
  VisitSettings(reader, settings);
  ARGMESH_RETURN_IF_ERROR(reader.Finish());
  return settings;
}

std::string SerializeMetadataKeys(const std::vector<MetadataKey>& keys) {
  FieldWriter writer;
  VisitKeys(writer, keys);
  return writer.TakeBytes();
}

absl::StatusOr<std::vector<MetadataKey>> ParseMetadataKeys(
    std::string_view bytes) {
  FieldReader reader(bytes, "metadata keys");
  std::vector<MetadataKey> keys;
  VisitKeys(reader, keys);
  ARGMESH_RETURN_IF_ERROR(reader.Finish());
  return keys;
}

std::string SerializeShapeDetails(const ShapeRecord& record) {
  FieldWriter writer;
  VisitReport(writer, record.report);
  VisitSummary(writer, record.graph);
  return writer.TakeBytes();
}

absl::Status ParseShapeDetails(std::string_view bytes, ShapeRecord& record) {
  FieldReader reader(bytes, "shape details");
  VisitReport(reader, record.report);
  VisitSummary(reader, record.graph);
  return reader.Finish();
}

std::string SerializeShapeRecord(const ShapeRecord& record) {
  FieldWriter writer;
  VisitShape(writer, record);
  return writer.TakeBytes();
}

absl::StatusOr<ShapeRecord> ParseShapeRecord(std::string_view bytes) {
  FieldReader reader(bytes, "shape record");
  ShapeRecord record;
  VisitShape(reader, record);
  ARGMESH_RETURN_IF_ERROR(reader.Finish());
  return record;
}

std::string SerializeCollectionRecord(const CollectionRecord& record) {
  FieldWriter writer;
  VisitCollection(writer, record);
  VisitKeys(writer, record.metadata_keys);
  return writer.TakeBytes();
}

absl::StatusOr<CollectionRecord> ParseCollectionRecord(std::string_view bytes) {
  FieldReader reader(bytes, "collection record");
  CollectionRecord record;
  VisitCollection(reader, record);
  // Records from before there were any end here.
  if (!reader.at_end()) VisitKeys(reader, record.metadata_keys);
  ARGMESH_RETURN_IF_ERROR(reader.Finish());
  return record;
}

std::string SerializeShapeWritten(const ShapeWritten& written) {
  FieldWriter writer;
  writer.Field(written.collection_uid);
  VisitShape(writer, written.record);
  return writer.TakeBytes();
}

absl::StatusOr<ShapeWritten> ParseShapeWritten(std::string_view bytes) {
  FieldReader reader(bytes, "remembered shape");
  ShapeWritten written;
  written.written = false;
  reader.Field(written.collection_uid);
  VisitShape(reader, written.record);
  ARGMESH_RETURN_IF_ERROR(reader.Finish());
  return written;
}

std::string SerializeShapeDeleted(const ShapeDeleted& deleted) {
  FieldWriter writer;
  writer.Field(deleted.collection_uid);
  writer.Field(deleted.generation);
  return writer.TakeBytes();
}

absl::StatusOr<ShapeDeleted> ParseShapeDeleted(std::string_view bytes) {
  FieldReader reader(bytes, "remembered deletion");
  ShapeDeleted deleted;
  reader.Field(deleted.collection_uid);
  reader.Field(deleted.generation);
  ARGMESH_RETURN_IF_ERROR(reader.Finish());
  return deleted;
}

std::string SerializeCollectionDeleted(const CollectionDeleted& deleted) {
  FieldWriter writer;
  writer.Field(deleted.uid);
  return writer.TakeBytes();
}

absl::StatusOr<CollectionDeleted> ParseCollectionDeleted(
    std::string_view bytes) {
  FieldReader reader(bytes, "remembered deletion");
  CollectionDeleted deleted;
  reader.Field(deleted.uid);
  ARGMESH_RETURN_IF_ERROR(reader.Finish());
  return deleted;
}

}  // namespace argmesh
