// Who calls, and whether they may.
//
// With keys, every call must carry one: `authorization: Bearer ID.SECRET`.
// Without keys everybody who can connect may do everything: a certificate of
// the client's, where TLS asks for one, only names them.
//
// Thread-safe; the keys may be replaced at any time and count from the next
// call on, and from the next message of those under way.
#ifndef ARGMESH_SERVER_RPC_ACCESS_CONTROL_H_
#define ARGMESH_SERVER_RPC_ACCESS_CONTROL_H_

#include <grpcpp/server_context.h>

#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "core/access/key_file.h"
#include "server/rpc/access_rules.h"
#include "server/rpc/key_quotas.h"

namespace argmesh {

struct Caller {
  std::string principal;  // a key's id, "cert:<name>", or empty
  AccessRole role = AccessRole::kAdmin;
  std::vector<std::string> collections;  // ids; empty: all
  KeyLimits limits = {};

  bool Covers(std::string_view collection) const;
};

class AccessControl {
 public:
  // None: no keys are asked for.
  void SetKeys(std::shared_ptr<const KeyRing> keys);
  bool has_keys() const;

  // Takes its place among the calls of its key; held until it has ended.
  // KEY_LIMIT_EXCEEDED.
  absl::StatusOr<KeyQuotas::Ticket> Admit(const Caller& caller) {
    return quotas_.Admit(caller.principal, caller.limits, absl::Now());
  }

  // kUnauthenticated KEY_MISSING, KEY_INVALID, KEY_EXPIRED.
  absl::StatusOr<Caller> Authenticate(
      const grpc::ServerContextBase& context) const;

 private:
  std::shared_ptr<const KeyRing> keys() const;

  mutable std::mutex mutex_;
  std::shared_ptr<const KeyRing> keys_;
  KeyQuotas quotas_;
};

// The caller of a bearer header; `keys` as of `now`. For tests too.
absl::StatusOr<Caller> CallerOfBearer(const KeyRing& keys,
                                      std::string_view header, absl::Time now);

// Role and whole-server rights, before anything of the request is known.
// kPermissionDenied PERMISSION_DENIED.
absl::Status CheckRole(const Caller& caller, std::string_view method);

// The names of a request, see RequestNames. A collection that the caller may
// not see gives the same answer whether it is there or not.
absl::Status CheckNames(const Caller& caller, std::string_view method,
                        const std::vector<std::string>& names);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_ACCESS_CONTROL_H_
