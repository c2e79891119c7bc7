// What an engine does beside its calls, on a thread of its own: it loads the
// gallery, sweeps the stores, then removes what deleted collections left and
// loads what could not be loaded before.
#ifndef ARGMESH_SERVER_ENGINE_HOUSEKEEPING_H_
#define ARGMESH_SERVER_ENGINE_HOUSEKEEPING_H_

#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <thread>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "core/base/stop_token.h"
#include "server/engine/catalog.h"
#include "server/engine/gallery.h"
#include "server/engine/ingest.h"
#include "server/engine/mesh_store.h"

namespace argmesh {

class Housekeeping {
 public:
  // Meshes that nothing names go once they are `sweep_age` old. All must
  // outlive this.
  Housekeeping(Catalog& catalog, MeshStore& meshes, Gallery& gallery,
               Ingest& ingest, absl::Duration sweep_age)
      : catalog_(catalog),
        meshes_(meshes),
        gallery_(gallery),
        ingest_(ingest),
        sweep_age_(sweep_age) {}

  // Once.
  void Start();
  // A collection was deleted. Thread-safe.
  void Wake();
  // Ends what is being done; the next start of the server goes on with it.
  // Idempotent.
  void Stop();

 private:
  void Run(const std::stop_token& stop);
  void Sweep(const StopToken& stop);
  // One piece of what deleted collections left; whether there may be more.
  absl::StatusOr<bool> RemoveSome();

  Catalog& catalog_;
  MeshStore& meshes_;
  Gallery& gallery_;
  Ingest& ingest_;
  const absl::Duration sweep_age_;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  bool woken_ = false;  // with mutex_
  std::jthread thread_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_HOUSEKEEPING_H_
