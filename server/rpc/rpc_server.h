// The gRPC server: every service of argmesh.v1, health and reflection over one
// listening address.
//
// Health   SearchService and "" are SERVING while the engine's index serves,
//          the other services from the start; "liveness" as long as the
//          process lives. All but "liveness" are NOT_SERVING from StartDrain.
// Fails    kInvalidArgument  the address is malformed, or not loopback without
//                            TLS and callers that are known (keys or
//                            client certificates), or `insecure_remote`;
//                            the certificate files are unusable
//          kUnavailable      the address cannot be bound
// Thread-safe.
#ifndef ARGMESH_SERVER_RPC_RPC_SERVER_H_
#define ARGMESH_SERVER_RPC_RPC_SERVER_H_

#include <memory>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "server/engine/engine.h"
#include "server/engine/operation_store.h"
#include "server/rpc/service_environment.h"
#include "server/rpc/transport_security.h"
#include "server/telemetry/gauge_sheet.h"
#include "server/telemetry/telemetry.h"

namespace grpc {
class Channel;
}

namespace argmesh {

struct RpcServerOptions {
  // HOST:PORT, [IPV6]:PORT; port 0 takes a free one.
  std::string listen = "127.0.0.1:7411";
  TlsOptions tls;
  // Callers must show one of these; none: everybody who can connect is let in.
  std::shared_ptr<const KeyRing> keys;
  // Bind other than loopback although calls are not encrypted, or callers not
  // known.
  bool insecure_remote = false;
  bool reflection = true;
  // Must outlive the server; none: snapshots and verification are not served.
  StoreAdmin* store_admin = nullptr;
  // Must outlive the server; none: imports are refused.
  const ImportSource* import_source = nullptr;
  // Must outlive the server; none: operations are forgotten with it.
  OperationStore* operation_store = nullptr;
  std::string version;
  ServiceLimits limits;
};

// OK when the server may bind `options.listen`.
absl::Status CheckListenAddress(const RpcServerOptions& options);

class RpcServer {
 public:
  // `engine` and `telemetry` must outlive the server.
  static absl::StatusOr<std::unique_ptr<RpcServer>> Start(
      const RpcServerOptions& options, Engine& engine, Telemetry& telemetry);
  ~RpcServer();  // Shutdown at once

  // HOST:PORT with the bound port.
  const std::string& address() const;
  int port() const;

  // From now on; what is in flight stays.
  void SetLimits(const ServiceLimits& limits);
  // None: every call is let in.
  void SetKeys(std::shared_ptr<const KeyRing> keys);

  void WriteGauges(GaugeSheet& sheet) const;

  // A channel to this server that needs no socket.
  std::shared_ptr<grpc::Channel> InProcessChannel();

  // NOT_SERVING; calls still come in.
  void StopAdvertising();

  // New calls are refused with DRAINING, those in flight may finish until
  // `deadline` and are then cancelled; operations are cancelled at once.
  // Returns when gRPC and all operations are done; true when no call was cut
  // off. The first call decides.
  bool Shutdown(absl::Time deadline);

 private:
  class Impl;
  explicit RpcServer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_RPC_SERVER_H_
