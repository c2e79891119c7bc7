#include "tests/support/catalog_samples.h"

#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "core/containment/window_codec.h"
#include "core/graph/graph_codec.h"
#include "core/signature/signature_codec.h"
#include "server/engine/mesh_analysis.h"
#include "server/engine/record_codec.h"
#include "server/engine/uid.h"
#include "tests/support/random_graph.h"

namespace argmesh {
namespace {

constexpr absl::Duration kRemembered = absl::Hours(1);

Sha256Digest SampleMesh(uint64_t seed) {
  return ComputeSha256(absl::StrFormat("mesh %d", seed));
}

absl::Time SampleTime() { return absl::FromUnixMicros(1'700'000'000'123'456); }

WindowWords SampleWords(uint64_t seed) {
  WindowWords words;
  words.levels[0] = {static_cast<uint16_t>(seed % 1000)};
  return words;
}

TargetWindows SampleWindows(uint64_t seed) {
  TargetWindows windows;
  windows.points.push_back(
      PackPoint({static_cast<float>(seed % 8), 0, 0}, {0, 0, 1}));
  return windows;
}

}  // namespace

CollectionRecord SampleCollection(const std::string& id) {
  CollectionRecord record;
  record.id = id;
  record.uid = MakeUid();
  record.display_name = "All the " + id;
  record.settings.vertex_budget = 500;
  record.graph_version = kShapeGraphVersion;
  record.create_time = SampleTime();
  record.update_time = SampleTime();
  return record;
}

ShapePut SamplePut(const CollectionRecord& collection, const std::string& id,
                   uint64_t seed) {
  const ShapeGraph graph = MakeRandomGraph(seed);
  ShapePut put;
  put.collection_uid = collection.uid;
  put.settings = collection.settings;
  put.graph_version = kShapeGraphVersion;
  put.graph = SerializeShapeGraph(graph);
  put.labels = SerializeFaceLabels(MakeRandomFaceLabels(seed, 300));
  put.descriptors = {EncodeSignature(SampleSignature(seed)),
                     SerializeWindowWords(SampleWords(seed)),
                     SerializeTargetWindows(SampleWindows(seed))};
  ShapeRecord& record = put.record;
  record.collection = collection.id;
  record.id = id;
  record.uid = MakeUid();
  record.display_name = "The \"" + id + "\"";
  record.source_uri = "file:///" + id + ".off";
  record.metadata = {{"colour", "blue"}, {"größe", "1 \\ 2\n"}};
  record.sha256 = SampleMesh(seed);
  record.size_bytes = 1000 + static_cast<int64_t>(seed);
  record.format = MeshFormat::kPly;
  record.mesh_stored = true;
  record.report.faces = 300;
  record.report.area = 2.5;
  record.report.smoothed = true;
  record.graph = SummarizeGraph(graph);
  record.create_time = SampleTime() + absl::Seconds(seed);
  record.update_time = record.create_time;
  return put;
}

SettingsStage SampleStage(int vertex_budget) {
  SettingsStage stage;
  stage.settings = SampleCollection("any").settings;
  stage.settings.vertex_budget = vertex_budget;
  stage.graph_version = kShapeGraphVersion;
  return stage;
}

StagedDescription SampleDescription(const SettingsStage& stage, uint64_t seed) {
  const auto budget = static_cast<uint64_t>(stage.settings.vertex_budget);
  const uint64_t other = 1000 * budget + seed;
  const ShapeGraph graph = MakeRandomGraph(other);
  StagedDescription description;
  description.stage = stage;
  description.report.faces = 300;
  description.report.area = static_cast<double>(budget);
  description.summary = SummarizeGraph(graph);
  description.graph = SerializeShapeGraph(graph);
  description.labels = SerializeFaceLabels(MakeRandomFaceLabels(other, 300));
  return description;
}

ShapeStaging SampleStaging(const CollectionRecord& collection,
                           const std::string& id, uint64_t seed,
                           const SettingsStage& stage) {
  return {collection.id, collection.uid, id, SampleMesh(seed),
          SampleDescription(stage, seed)};
}

ShapeSignature SampleSignature(uint64_t seed) {
  ShapeSignature signature;
  signature.point.assign(kPointDims, 0);
  signature.view.assign(kViewDims, 0);
  signature.point[seed % kPointDims] = 1;
  signature.view[seed % kViewDims] = 1;
  return signature;
}

RequestStamp SampleRequest(char digit, std::string_view method,
                           std::string_view asked) {
  RequestStamp stamp;
  stamp.principal = "somebody";
  stamp.request_id =
      "00000000-0000-4000-8000-00000000000" + std::string(1, digit);
  stamp.method = std::string(method);
  stamp.hash = ComputeSha256(asked);
  stamp.expire_time = absl::Now() + kRemembered;
  return stamp;
}

bool SameRecord(const ShapeRecord& a, const ShapeRecord& b) {
  return SerializeShapeRecord(a) == SerializeShapeRecord(b);
}

}  // namespace argmesh
