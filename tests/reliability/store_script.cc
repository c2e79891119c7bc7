#include "tests/reliability/store_script.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"
#include "tests/support/catalog_dump.h"
#include "tests/support/catalog_samples.h"
#include "tests/support/memory_mesh_store.h"

namespace argmesh {
namespace {

constexpr uint64_t kMeshes = 12;
constexpr uint64_t kShapes = 8;
constexpr uint64_t kMaxMeshBytes = 40'000;

std::string MeshBytes(uint64_t mesh) {
  Random random(mesh);
  std::string bytes(1 + random.Below(kMaxMeshBytes), '\0');
  for (char& byte : bytes) byte = static_cast<char>(random.Below(256));
  return bytes;
}

// Failures are left to the next sweep.
void RemoveMeshes(const std::vector<Sha256Digest>& unreferenced,
                  const Catalog& catalog, MeshStore& meshes) {
  for (const Sha256Digest& sha256 : unreferenced) {
    (void)meshes.RemoveUnreferenced(sha256, [&](const Sha256Digest& digest) {
      return catalog.IsMeshReferenced(digest);
    });
  }
}

absl::StatusOr<MeshPin> Publish(const std::string& bytes, MeshStore& meshes) {
  ARGMESH_ASSIGN_OR_RETURN(
      const std::unique_ptr<MeshWriter> writer,
      meshes.StartWrite(static_cast<int64_t>(bytes.size())));
  ARGMESH_RETURN_IF_ERROR(writer->Append(bytes));
  ARGMESH_ASSIGN_OR_RETURN(const std::unique_ptr<StagedMesh> staged,
                           writer->Seal());
  return staged->Publish();
}

absl::Status RunPut(const ShapePut& put, const std::string& bytes,
                    Catalog& catalog, MeshStore& meshes) {
  absl::StatusOr<ShapeWritten> written;
  {
    ARGMESH_ASSIGN_OR_RETURN(const MeshPin pin, Publish(bytes, meshes));
    written = catalog.PutShape(put);
  }
  if (!written.ok()) {
    RemoveMeshes({put.record.sha256}, catalog, meshes);
    return written.status();
  }
  RemoveMeshes(written->unreferenced, catalog, meshes);
  return absl::OkStatus();
}

}  // namespace

StoreScript::StoreScript(std::string collection, uint64_t seed, size_t steps)
    : collection_(std::move(collection)), random_(seed) {
  MemoryMeshStore meshes;
  states_.push_back(DumpCollection(model_, collection_));
  for (size_t i = 0; i < steps; ++i) {
    steps_.push_back(Next());
    // Also a step that is refused, such as of a shape that is not there,
    // belongs to the script.
    (void)steps_.back()(model_, meshes);
    states_.push_back(DumpCollection(model_, collection_));
  }
}

StoreScript::Step StoreScript::Next() {
  if (!model_.GetCollection(collection_).ok()) return Insert();
  const uint64_t what = random_.Below(100);
  if (what < 45) return Put();
  if (what < 55) return Update();
  if (what < 65) return DeleteShape();
  if (what < 98) return Reindex();
  return DeleteCollection();
}

std::string StoreScript::RandomId() {
  return absl::StrCat("s", random_.Below(kShapes));
}

StoreScript::Step StoreScript::Insert() {
  stage_.reset();
  CollectionRecord record = SampleCollection(collection_);
  record.metadata_keys = {{"colour", MetadataType::kString}};
  return [record](Catalog& catalog, MeshStore&) {
    return catalog.InsertCollection(record, {}).status();
  };
}

StoreScript::Step StoreScript::Put() {
  const uint64_t mesh = random_.Below(kMeshes);
  const std::string bytes = MeshBytes(mesh);
  ShapePut put =
      SamplePut(*model_.GetCollection(collection_), RandomId(), mesh);
  put.record.sha256 = ComputeSha256(bytes);
  put.record.size_bytes = static_cast<int64_t>(bytes.size());
  put.if_exists = IfExists::kReplace;
  return [put, bytes](Catalog& catalog, MeshStore& meshes) {
    return RunPut(put, bytes, catalog, meshes);
  };
}

StoreScript::Step StoreScript::Update() {
  ShapePatch patch;
  patch.collection = collection_;
  patch.id = RandomId();
  patch.metadata = {{"colour", absl::StrCat("colour ", random_.Below(100))}};
  patch.update_time = absl::FromUnixSeconds(1'700'000'000);
  return [patch](Catalog& catalog, MeshStore&) {
    return catalog.UpdateShape(patch).status();
  };
}

StoreScript::Step StoreScript::DeleteShape() {
  const ShapeDelete removal{collection_, RandomId(), "", {}};
  return [removal](Catalog& catalog, MeshStore& meshes) -> absl::Status {
    ARGMESH_ASSIGN_OR_RETURN(const ShapeDeleted deleted,
                             catalog.DeleteShape(removal));
    RemoveMeshes(deleted.unreferenced, catalog, meshes);
    return absl::OkStatus();
  };
}

StoreScript::Step StoreScript::Reindex() {
  const CollectionRecord collection = *model_.GetCollection(collection_);
  if (!stage_ || stage_->settings == collection.settings) {
    stage_ = SampleStage(600 + static_cast<int>(random_.Below(100)));
    return [collection, stage = *stage_](Catalog& catalog, MeshStore&) {
      return catalog.BeginStage(collection.id, collection.uid, stage);
    };
  }
  const std::vector<std::string> unstaged =
      *model_.ListUnstaged(collection.uid, "", 1);
  if (!unstaged.empty()) {
    ShapeStaging staging =
        SampleStaging(collection, unstaged[0], random_.Below(kMeshes), *stage_);
    staging.sha256 = model_.GetShape(collection_, staging.id)->sha256;
    return [staging](Catalog& catalog, MeshStore&) {
      return catalog.StageShape(staging);
    };
  }
  const SettingsSwitch change{collection.id, collection.uid, *stage_,
                              absl::FromUnixSeconds(1'800'000'000)};
  return [change](Catalog& catalog, MeshStore&) -> absl::Status {
    ARGMESH_RETURN_IF_ERROR(catalog.SwitchSettings(change).status());
    (void)catalog.RemoveUnusedGraphs({});
    return absl::OkStatus();
  };
}

StoreScript::Step StoreScript::DeleteCollection() {
  const CollectionDelete removal{collection_, true, ""};
  return [removal](Catalog& catalog, MeshStore& meshes) -> absl::Status {
    ARGMESH_ASSIGN_OR_RETURN(const CollectionDeleted deleted,
                             catalog.DeleteCollection(removal));
    RemoveMeshes(deleted.unreferenced, catalog, meshes);
    // A failure here is none of the deletion: what is left goes later.
    absl::StatusOr<RemovedShapes> removed = catalog.RemoveSomeDeleted();
    while (removed.ok() && removed->more) {
      RemoveMeshes(removed->unreferenced, catalog, meshes);
      removed = catalog.RemoveSomeDeleted();
    }
    return absl::OkStatus();
  };
}

}  // namespace argmesh
