// The engine's calls that read and change records.
#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "core/base/status_macros.h"
#include "core/graph/shape_graph.h"
#include "server/engine/engine.h"
#include "server/engine/engine_parts.h"
#include "server/engine/page_token.h"
#include "server/engine/record_codec.h"
#include "server/engine/request_rules.h"
#include "server/engine/request_stamp.h"
#include "server/engine/uid.h"

namespace argmesh {
namespace {

// Stored times have microseconds.
absl::Time NowInMicros() {
  return absl::FromUnixMicros(absl::ToUnixMicros(absl::Now()));
}

// A field of a request's stamp: one that is empty reads unlike one that is not
// there.
template <typename Value, typename Serialize = std::identity>
std::string OptionalField(const std::optional<Value>& value,
                          const Serialize& serialize = {}) {
  return value ? "=" + serialize(*value) : "";
}

// Cuts `records`, of which one more than a page may hold was read, to a page;
// returns the token of the next page.
template <typename Record, typename Size>
std::string CutPage(std::vector<Record>& records, size_t page_size,
                    int64_t max_bytes, const std::string& list, Size size_of) {
  size_t kept = 0;
  int64_t bytes = 0;
  while (kept < std::min(records.size(), page_size)) {
    bytes += static_cast<int64_t>(size_of(records[kept]));
    if (kept > 0 && bytes > max_bytes) break;
    ++kept;
  }
  if (kept == records.size()) return "";
  records.resize(kept);
  return MakePageToken(list, records.back().id);
}

}  // namespace

absl::StatusOr<CollectionRecord> Engine::CreateCollection(
    const NewCollection& spec) {
  ARGMESH_RETURN_IF_ERROR(parts_->CheckOpen());
  ARGMESH_RETURN_IF_ERROR(CheckNewCollection(spec));
  ARGMESH_ASSIGN_OR_RETURN(
      const RequestStamp request,
      parts_->Stamp(spec.request, "CreateCollection",
                    {spec.id, spec.display_name,
                     SerializeCollectionSettings(spec.settings),
                     SerializeMetadataKeys(spec.metadata_keys)}));
  CollectionRecord record;
  record.id = spec.id;
  record.uid = MakeUid();
  record.display_name = spec.display_name;
  record.settings = spec.settings;
  record.metadata_keys = spec.metadata_keys;
  record.graph_version = kShapeGraphVersion;
  record.create_time = NowInMicros();
  record.update_time = record.create_time;
  const auto lock = parts_->gallery.LockCollections();
  ARGMESH_ASSIGN_OR_RETURN(CollectionRecord stored,
                           parts_->catalog->InsertCollection(record, request));
  // An answer to a retry has the first call's uid.
  if (stored.uid == record.uid) parts_->gallery.Add(stored);
  return stored;
}

absl::StatusOr<CollectionRecord> Engine::GetCollection(
    std::string_view id) const {
  ARGMESH_RETURN_IF_ERROR(parts_->CheckOpen());
  ARGMESH_RETURN_IF_ERROR(CheckId("collection", id));
  return parts_->catalog->GetCollection(id);
}

absl::StatusOr<CollectionPage> Engine::ListCollections(
    const PageRequest& page) const {
  ARGMESH_RETURN_IF_ERROR(parts_->CheckOpen());
  const std::string list = "collections";
  ARGMESH_ASSIGN_OR_RETURN(const int size, CheckPageSize(page.page_size));
  ARGMESH_ASSIGN_OR_RETURN(const std::string after,
                           ParsePageToken(list, page.page_token));
  CollectionPage answer;
  ARGMESH_ASSIGN_OR_RETURN(answer.collections,
                           parts_->catalog->ListCollections(after, size + 1));
  answer.next_page_token =
      CutPage(answer.collections, static_cast<size_t>(size), page.max_bytes,
              list, [](const CollectionRecord& record) {
                return SerializeCollectionRecord(record).size();
              });
  return answer;
}

absl::StatusOr<CollectionRecord> Engine::UpdateCollection(
    CollectionPatch patch, const RequestKey& key) {
  ARGMESH_RETURN_IF_ERROR(parts_->CheckOpen());
  ARGMESH_RETURN_IF_ERROR(CheckId("collection", patch.id));
  if (patch.display_name) {
    ARGMESH_RETURN_IF_ERROR(
        CheckText("display_name", *patch.display_name, kMaxDisplayNameBytes));
  }
  if (patch.metadata_keys) {
    ARGMESH_RETURN_IF_ERROR(CheckMetadataKeys(*patch.metadata_keys));
  }
  patch.update_time = NowInMicros();
  ARGMESH_ASSIGN_OR_RETURN(
      patch.request,
      parts_->Stamp(
          key, "UpdateCollection",
          {patch.id, patch.etag, OptionalField(patch.display_name),
           OptionalField(patch.metadata_keys, SerializeMetadataKeys)}));
  return parts_->catalog->UpdateCollection(patch);
}

absl::Status Engine::DeleteCollection(CollectionDelete removal,
                                      const RequestKey& key) {
  ARGMESH_RETURN_IF_ERROR(parts_->CheckOpen());
  ARGMESH_RETURN_IF_ERROR(CheckId("collection", removal.id));
  ARGMESH_ASSIGN_OR_RETURN(
      removal.request,
      parts_->Stamp(key, "DeleteCollection",
                    {removal.id, removal.etag, removal.force ? "force" : ""}));
  CollectionDeleted deleted;
  {
    const auto lock = parts_->gallery.LockCollections();
    ARGMESH_ASSIGN_OR_RETURN(deleted,
                             parts_->catalog->DeleteCollection(removal));
    parts_->gallery.Remove(deleted.uid);
  }
  parts_->ingest.RemoveMeshes(deleted.unreferenced);
  parts_->housekeeping.Wake();
  return absl::OkStatus();
}

absl::StatusOr<ShapeRecord> Engine::GetShape(const ShapeRef& shape) const {
  ARGMESH_RETURN_IF_ERROR(parts_->CheckOpen());
  ARGMESH_RETURN_IF_ERROR(CheckShapeRef(shape));
  return parts_->catalog->GetShape(shape.collection, shape.id);
}

absl::StatusOr<ShapePage> Engine::ListShapes(std::string_view collection,
                                             const PageRequest& page,
                                             const std::string& filter) const {
  ARGMESH_RETURN_IF_ERROR(parts_->CheckOpen());
  ARGMESH_RETURN_IF_ERROR(CheckId("collection", collection));
  const std::string list = "shapes/" + std::string(collection) + "?" + filter;
  ARGMESH_ASSIGN_OR_RETURN(const int size, CheckPageSize(page.page_size));
  ARGMESH_ASSIGN_OR_RETURN(const std::string after,
                           ParsePageToken(list, page.page_token));
  ShapePage answer;
  ARGMESH_ASSIGN_OR_RETURN(
      answer.shapes,
      parts_->catalog->ListShapes(collection, {after, size + 1, filter}));
  answer.next_page_token =
      CutPage(answer.shapes, static_cast<size_t>(size), page.max_bytes, list,
              [](const ShapeRecord& record) {
                return SerializeShapeRecord(record).size();
              });
  return answer;
}

absl::StatusOr<ShapeRecord> Engine::UpdateShape(ShapePatch patch,
                                                const RequestKey& key) {
  ARGMESH_RETURN_IF_ERROR(parts_->CheckOpen());
  ARGMESH_RETURN_IF_ERROR(CheckPatch(patch));
  patch.update_time = NowInMicros();
  std::vector<std::string> fields = {patch.collection, patch.id, patch.etag,
                                     OptionalField(patch.display_name),
                                     OptionalField(patch.source_uri)};
  if (patch.metadata) {
    fields.emplace_back("metadata");
    AddFields(*patch.metadata, fields);
  }
  ARGMESH_ASSIGN_OR_RETURN(patch.request,
                           parts_->Stamp(key, "UpdateShape", fields));
  ARGMESH_ASSIGN_OR_RETURN(ShapeWritten written,
                           parts_->catalog->UpdateShape(patch));
  parts_->gallery.Follow(patch.collection, written.collection_uid,
                         written.record.generation, std::nullopt);
  return std::move(written.record);
}

absl::StatusOr<int64_t> Engine::DeleteShape(const ShapeRemoval& removal) {
  ARGMESH_RETURN_IF_ERROR(parts_->CheckOpen());
  ARGMESH_RETURN_IF_ERROR(CheckShapeRef(removal.shape));
  ShapeDelete request;
  request.collection = removal.shape.collection;
  request.id = removal.shape.id;
  request.etag = removal.etag;
  ARGMESH_ASSIGN_OR_RETURN(
      request.request,
      parts_->Stamp(removal.request, "DeleteShape",
                    {request.collection, request.id, request.etag}));
  ARGMESH_ASSIGN_OR_RETURN(const ShapeDeleted deleted,
                           parts_->catalog->DeleteShape(request));
  return parts_->FollowDeletion(request.collection, deleted);
}

absl::StatusOr<int64_t> Engine::DeleteShapes(ShapesDelete removal,
                                             const RequestKey& key) {
  ARGMESH_RETURN_IF_ERROR(parts_->CheckOpen());
  std::vector<std::string> fields = {removal.collection};
  for (const std::string& id : removal.ids) {
    ARGMESH_RETURN_IF_ERROR(CheckShapeRef({removal.collection, id}));
    fields.push_back(id);
  }
  ARGMESH_ASSIGN_OR_RETURN(removal.request,
                           parts_->Stamp(key, "DeleteShapes", fields));
  ARGMESH_ASSIGN_OR_RETURN(const ShapeDeleted deleted,
                           parts_->catalog->DeleteShapes(removal));
  return parts_->FollowDeletion(removal.collection, deleted);
}

absl::StatusOr<RequestStamp> Engine::Parts::Stamp(
    const RequestKey& key, std::string_view method,
    const std::vector<std::string>& fields) const {
  return StampRequest(key, method, fields,
                      absl::Now() + options.request_memory);
}

int64_t Engine::Parts::FollowDeletion(const std::string& collection,
                                      const ShapeDeleted& deleted) {
  gallery.Follow(collection, deleted.collection_uid, deleted.generation,
                 std::nullopt);
  ingest.RemoveMeshes(deleted.unreferenced);
  return deleted.generation;
}

}  // namespace argmesh
