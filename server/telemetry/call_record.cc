#include "server/telemetry/call_record.h"

namespace argmesh {

MethodName FullName(std::string_view method) {
  const size_t dot = method.find('.');
  const std::string_view service = method.substr(0, dot);
  // The one service of another package.
  const std::string package =
      service == "Operations" ? "google.longrunning." : "argmesh.v1.";
  return {package + std::string(service), std::string(method.substr(dot + 1))};
}

}  // namespace argmesh
