// The address a server listens on.
#ifndef ARGMESH_SERVER_RPC_LISTEN_ADDRESS_H_
#define ARGMESH_SERVER_RPC_LISTEN_ADDRESS_H_

#include <string>
#include <string_view>

#include "absl/status/statusor.h"

namespace argmesh {

struct ListenAddress {
  std::string host;  // without brackets
  int port = 0;      // 0: any free one
  bool loopback = false;

  // HOST:PORT, with brackets around an IPv6 host.
  std::string ToString() const;
};

// "127.0.0.1:7411", "[::1]:0", "localhost:7411". kInvalidArgument otherwise. A
// host name other than "localhost" is not looked up and not loopback.
absl::StatusOr<ListenAddress> ParseListenAddress(std::string_view text);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_LISTEN_ADDRESS_H_
