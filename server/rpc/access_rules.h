// What each rpc asks of its caller.
//
// One line for every rpc of every service; what has no line is refused. The
// matrix test reads the services' descriptors and finds a line that is
// missing.
#ifndef ARGMESH_SERVER_RPC_ACCESS_RULES_H_
#define ARGMESH_SERVER_RPC_ACCESS_RULES_H_

#include <span>
#include <string_view>

#include "core/access/api_key.h"

namespace argmesh {

enum class AccessScope {
  kCollection,  // every resource of the request lies in the caller's
                // collections, and there is one
  kAny,         // any caller of the role; the answer depends on the caller
                // where it names collections
  kServer,      // the whole server: callers that are bound to collections are
                // refused
};

struct AccessRule {
  std::string_view method;  // "ShapeService.GetShape"
  AccessRole role;
  AccessScope scope;
  bool writes;  // goes to the audit log
};

std::span<const AccessRule> AccessRules();

// None: no such line.
const AccessRule* FindAccessRule(std::string_view method);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_ACCESS_RULES_H_
