#include "server/engine/page_token.h"

#include <algorithm>

#include "absl/strings/escaping.h"
#include "core/base/byte_reader.h"
#include "core/base/byte_writer.h"
#include "core/base/crc32c.h"
#include "core/base/identifier.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"
#include "server/engine/uid.h"

namespace argmesh {
namespace {

constexpr uint8_t kTokenVersion = 1;
constexpr int kDefaultPageSize = 100;
constexpr int kMaxPageSize = 1000;

uint32_t Checksum(std::string_view list, std::string_view last_id) {
  return ComputeCrc32c(std::string(list) + '\n' + std::string(last_id));
}

absl::StatusOr<std::string> ReadToken(std::string_view list,
                                      std::string_view bytes) {
  ByteReader reader(bytes, "page token");
  ARGMESH_ASSIGN_OR_RETURN(const uint8_t version, reader.ReadU8());
  ARGMESH_ASSIGN_OR_RETURN(const uint32_t checksum, reader.ReadU32());
  ARGMESH_ASSIGN_OR_RETURN(const std::string_view id,
                           reader.ReadBytes(reader.remaining()));
  if (version != kTokenVersion || checksum != Checksum(list, id) ||
      !(IsIdentifier(id) || IsUid(id))) {
    return absl::DataLossError("not a page token of this list");
  }
  return std::string(id);
}

}  // namespace

std::string MakePageToken(std::string_view list, std::string_view last_id) {
  ByteWriter writer;
  writer.WriteU8(kTokenVersion);
  writer.WriteU32(Checksum(list, last_id));
  writer.WriteBytes(last_id);
  return absl::WebSafeBase64Escape(writer.bytes());
}

absl::StatusOr<std::string> ParsePageToken(std::string_view list,
                                           std::string_view token) {
  if (token.empty()) return std::string();
  std::string bytes;
  if (absl::WebSafeBase64Unescape(absl::string_view(token.data(), token.size()),
                                  &bytes)) {
    absl::StatusOr<std::string> id = ReadToken(list, bytes);
    if (id.ok()) return id;
  }
  return MakeError(ErrorReason::kPageTokenInvalid,
                   "the page token is not one of this list",
                   {{"field", "page_token"}});
}

absl::StatusOr<int> CheckPageSize(int page_size) {
  if (page_size < 0) {
    return MakeError(ErrorReason::kFieldInvalid, "page_size is negative",
                     {{"field", "page_size"}});
  }
  if (page_size == 0) return kDefaultPageSize;
  return std::min(page_size, kMaxPageSize);
}

}  // namespace argmesh
