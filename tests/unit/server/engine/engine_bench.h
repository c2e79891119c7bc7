// An engine on fakes, and small meshes to give it.
#ifndef ARGMESH_TESTS_UNIT_SERVER_ENGINE_ENGINE_BENCH_H_
#define ARGMESH_TESTS_UNIT_SERVER_ENGINE_ENGINE_BENCH_H_

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "core/mesh/mesh_write.h"
#include "server/engine/engine.h"
#include "server/engine/error_reason.h"
#include "tests/support/memory_catalog.h"
#include "tests/support/memory_mesh_store.h"
#include "tests/support/status_matchers.h"
#include "tests/support/test_meshes.h"

namespace argmesh {

// Few samples and no cells: a graph in tens of milliseconds.
inline CollectionSettings QuickSettings() {
  CollectionSettings settings;
  settings.vertex_budget = 300;
  settings.uniform_cells = 4;
  return settings;
}

// A torus whose tube has `tenths` tenths of its ring's radius, as OFF.
inline std::string TorusOff(int tenths) {
  return SerializeMesh(MakeTorus(1, 0.1 * tenths, 24, 12), MeshFormat::kOff)
      .value();
}

inline std::string DumbbellOff() {
  return SerializeMesh(MakeDumbbell(16), MeshFormat::kOff).value();
}

template <typename T>
ErrorReason ReasonOrOk(const absl::StatusOr<T>& result) {
  return ReasonOf(result.status()).value_or(ErrorReason{0});
}
inline ErrorReason ReasonOrOk(const absl::Status& status) {
  return ReasonOf(status).value_or(ErrorReason{0});
}

class EngineTest : public ::testing::Test {
 protected:
  void SetUp() override { Start({}); }

  void Start(const EngineOptions& options) {
    auto catalog = std::make_unique<MemoryCatalog>();
    auto meshes = std::make_unique<MemoryMeshStore>();
    catalog_ = catalog.get();
    meshes_ = meshes.get();
    ASSERT_OK_AND_ASSIGN(engine_, Engine::Create(options, std::move(catalog),
                                                 std::move(meshes)));
    ASSERT_TRUE(engine_->WaitUntilServing().ok());
    NewCollection cups;
    cups.id = "cups";
    cups.settings = QuickSettings();
    ASSERT_THAT(engine_->CreateCollection(cups), IsOk());
  }

  static NewShape Named(const std::string& id) {
    NewShape shape;
    shape.collection = "cups";
    shape.id = id;
    return shape;
  }

  SearchQuery SearchFor(QueryShape shape) const {
    SearchQuery query;
    query.collection = "cups";
    query.query = std::move(shape);
    return query;
  }

  MemoryCatalog* catalog_ = nullptr;  // the engine's
  MemoryMeshStore* meshes_ = nullptr;
  std::unique_ptr<Engine> engine_;
};

}  // namespace argmesh

#endif  // ARGMESH_TESTS_UNIT_SERVER_ENGINE_ENGINE_BENCH_H_
