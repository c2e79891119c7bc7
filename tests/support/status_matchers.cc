#include "tests/support/status_matchers.h"

namespace argmesh {

const absl::Status& StatusOf(const absl::Status& status) { return status; }

}  // namespace argmesh
