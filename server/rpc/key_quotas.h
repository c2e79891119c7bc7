// How much each API key may use: calls a second and calls at once (KeyLimits).
//
// A token bucket of `burst` calls for each key, filled at its rate, and a count
// of its calls that have not ended. A stream is one call, whatever it carries.
// What is refused uses nothing. Thread-safe.
#ifndef ARGMESH_SERVER_RPC_KEY_QUOTAS_H_
#define ARGMESH_SERVER_RPC_KEY_QUOTAS_H_

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "core/access/key_file.h"

namespace argmesh {

class KeyQuotas {
 public:
  // One call of a key; ends when the last copy goes.
  using Ticket = std::shared_ptr<void>;

  // KEY_LIMIT_EXCEEDED with the limit in metadata `limit` and the time after
  // which the next call may be let in. A null ticket for a key without limits.
  absl::StatusOr<Ticket> Admit(const std::string& id, const KeyLimits& limits,
                               absl::Time now);

  // Forgets keys that are not among them.
  void KeepOnly(const KeyRing& keys);

 private:
  struct Usage;

  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Usage>> usages_;  // by id of the key
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_KEY_QUOTAS_H_
