// A server at work: storage, engine, gRPC, telemetry and metrics, wired
// together and taken down in order.
#ifndef ARGMESH_SERVER_SERVING_H_
#define ARGMESH_SERVER_SERVING_H_

#include <memory>
#include <ostream>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "core/base/stop_token.h"
#include "server/engine/engine.h"
#include "server/options.h"
#include "server/rpc/rpc_server.h"
#include "server/storage/import_root.h"
#include "server/storage/operation_directory.h"
#include "server/storage/snapshot_directory.h"
#include "server/telemetry/metrics_endpoint.h"
#include "server/telemetry/telemetry.h"

namespace argmesh {

// Everything of the options that can be checked without opening the store:
// addresses, certificates, keys. kInvalidArgument and others, naming the
// option.
absl::Status CheckServerOptions(const ServerOptions& options);

// Puts the snapshot in `options.restore` in the place of the data, and tells
// `out` what it did. As RestoreSnapshot.
absl::Status Restore(const ServerOptions& options, std::ostream& out);

class Serving {
 public:
  // Serves when it returns. The log goes to `log`, which must outlive it.
  // Nothing listens while the store is opened, which may take minutes when the
  // last stop was not clean; fails as `stop` when that ends it.
  static absl::StatusOr<std::unique_ptr<Serving>> Start(
      const ServerOptions& options, std::ostream& log, const StopToken& stop);
  ~Serving();

  EventLog& log() { return telemetry_->log(); }
  RpcServer& rpc() { return *rpc_; }

  // Applies log level, limits and keys, and opens the log files again. Other
  // options that differ from those of the start are named in the log and left.
  // A failure (of the keys) is logged, and what was in force stays.
  void Reload(const ServerOptions& options);

  // Not `absl::OkStatus()` when the store could not be closed.
  absl::Status Close();

 private:
  Serving() = default;
  absl::Status OpenStore(const StopToken& stop);
  absl::Status StartMetrics();

  ServerOptions options_;
  std::unique_ptr<Telemetry> telemetry_;
  std::unique_ptr<Engine> engine_;
  std::unique_ptr<SnapshotDirectory> snapshots_;  // uses the engine's meshes
  std::unique_ptr<OperationDirectory> operations_;
  std::unique_ptr<ImportRoot> import_root_;
  std::unique_ptr<RpcServer> rpc_;
  std::unique_ptr<MetricsEndpoint> metrics_;  // goes first
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_SERVING_H_
