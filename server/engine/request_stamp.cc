#include "server/engine/request_stamp.h"

#include "absl/strings/ascii.h"
#include "absl/strings/str_format.h"
#include "core/base/sha256.h"
#include "server/engine/error_reason.h"
#include "server/engine/uid.h"

namespace argmesh {

absl::StatusOr<RequestStamp> StampRequest(
    const RequestKey& key, std::string_view method,
    const std::vector<std::string>& fields, absl::Time expire_time) {
  RequestStamp stamp;
  if (key.request_id.empty()) return stamp;
  if (!IsUid(key.request_id)) {
    return MakeError(ErrorReason::kFieldInvalid, "request_id is not a UUID",
                     {{"field", "request_id"}});
  }
  stamp.principal = key.principal;
  stamp.request_id = absl::AsciiStrToLower(key.request_id);
  stamp.method = std::string(method);
  stamp.expire_time = expire_time;
  Sha256Hasher hasher;
  hasher.Update(method);
  for (const std::string& field : fields) {
    // With its length, so that no two lists of fields read alike.
    hasher.Update(absl::StrFormat("\n%d:", field.size()));
    hasher.Update(field);
  }
  stamp.hash = hasher.Finish();
  return stamp;
}

void AddFields(const std::map<std::string, std::string>& metadata,
               std::vector<std::string>& fields) {
  for (const auto& [key, value] : metadata) {
    fields.push_back(key);
    fields.push_back(value);
  }
}

}  // namespace argmesh
