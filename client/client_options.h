// How a Client reaches its server.
#ifndef ARGMESH_CLIENT_CLIENT_OPTIONS_H_
#define ARGMESH_CLIENT_CLIENT_OPTIONS_H_

#include <cstdint>
#include <string>

#include "absl/time/time.h"

namespace argmesh {

// Waits before a call is tried again: each `multiplier` times the one before,
// of which a random half is left out so that many clients do not come back at
// once. A longer wait that the server asks for is honoured.
struct RetryOptions {
  int max_attempts = 5;  // >= 1; 1 never tries again
  absl::Duration initial_backoff = absl::Milliseconds(100);  // > 0
  absl::Duration max_backoff = absl::Seconds(5);             // >= initial
  double multiplier = 2;                                     // >= 1
};

// Encryption. The files are in PEM form and read once.
struct ClientTls {
  bool enabled = false;     // false: plain text
  std::string authorities;  // of the server's certificate; empty: the system's
  std::string certificate;  // the client's own chain; empty: none
  std::string private_key;
  std::string server_name;  // that the certificate is for; empty: the host
};

struct ClientOptions {
  // Of one call with all its attempts, also an upload or download; > 0.
  absl::Duration call_timeout = absl::Seconds(120);
  // Of calls that may be repeated without harm.
  RetryOptions retry;
  ClientTls tls;
  // "ID.SECRET", see `argmesh keys`; empty: none. Without TLS whoever reads
  // the connection reads it too.
  std::string api_key;
  // Put before gRPC's own words in the user-agent header.
  std::string user_agent = "argmesh-client";
};

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_CLIENT_OPTIONS_H_
