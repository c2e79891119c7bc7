// One client's operations on a collection of its own, and what the collection
// holds after each of them. Known before they are run: equal seeds give equal
// steps but for uids.
//
// Meshes are few and shared with all other scripts, so that files come, are
// named by several shapes, go, and come again.
#ifndef ARGMESH_TESTS_RELIABILITY_STORE_SCRIPT_H_
#define ARGMESH_TESTS_RELIABILITY_STORE_SCRIPT_H_

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "core/base/random.h"
#include "server/engine/catalog.h"
#include "server/engine/mesh_store.h"
#include "tests/support/memory_catalog.h"

namespace argmesh {

class StoreScript {
 public:
  StoreScript(std::string collection, uint64_t seed, size_t steps);

  size_t size() const { return steps_.size(); }

  // As the engine does it: the mesh before the row, removals after it. OK:
  // acknowledged.
  absl::Status Run(size_t step, Catalog& catalog, MeshStore& meshes) const {
    return steps_[step](catalog, meshes);
  }

  // DumpCollection after the first `steps` were acknowledged, from nothing.
  const std::string& StateAfter(size_t steps) const { return states_[steps]; }
  const std::string& collection() const { return collection_; }

 private:
  using Step = std::function<absl::Status(Catalog&, MeshStore&)>;

  Step Next();
  Step Insert();
  Step Put();
  Step Update();
  Step DeleteShape();
  // The next one on the way to other settings.
  Step Reindex();
  Step DeleteCollection();
  std::string RandomId();

  const std::string collection_;
  Random random_;
  MemoryCatalog model_;
  std::optional<SettingsStage> stage_;  // that the collection was brought to
  std::vector<Step> steps_;
  std::vector<std::string> states_;
};

}  // namespace argmesh

#endif  // ARGMESH_TESTS_RELIABILITY_STORE_SCRIPT_H_
