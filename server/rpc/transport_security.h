// TLS of the server: its certificate, and the certificates it asks of clients.
//
// The files are looked at every second: a new certificate serves the next
// connection, without a restart and without cutting the others. While the
// files do not fit together the ones before stay in use.
#ifndef ARGMESH_SERVER_RPC_TRANSPORT_SECURITY_H_
#define ARGMESH_SERVER_RPC_TRANSPORT_SECURITY_H_

#include <grpcpp/security/server_credentials.h>

#include <memory>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace argmesh {

// PEM files.
struct TlsOptions {
  std::string certificate;  // the chain, leaf first; empty: no TLS
  std::string private_key;
  // Clients must show a certificate of one of these authorities; empty: they
  // are not asked.
  std::string client_authorities;

  bool enabled() const { return !certificate.empty(); }
};

// kInvalidArgument when an option is missing that another one needs, a file
// cannot be read as what it should be, or key and certificate do not fit.
absl::Status CheckTls(const TlsOptions& options);

// Insecure without TLS. As CheckTls.
absl::StatusOr<std::shared_ptr<grpc::ServerCredentials>> MakeServerCredentials(
    const TlsOptions& options);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_TRANSPORT_SECURITY_H_
