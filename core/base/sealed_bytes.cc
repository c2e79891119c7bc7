#include "core/base/sealed_bytes.h"

#include <cstdint>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "core/base/byte_reader.h"
#include "core/base/byte_writer.h"
#include "core/base/crc32c.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

uint32_t Checksum(std::string_view fields, std::string_view payload) {
  std::string all(fields);
  all.append(payload);
  return ComputeCrc32c(all);
}

}  // namespace

std::string SealBytes(std::string_view magic, uint32_t version,
                      std::string_view payload) {
  ByteWriter fields;
  fields.WriteBytes(magic);
  fields.WriteU32(version);
  fields.WriteU64(payload.size());
  ByteWriter writer;
  writer.WriteBytes(fields.bytes());
  writer.WriteU32(Checksum(fields.bytes(), payload));
  writer.WriteBytes(payload);
  return writer.TakeBytes();
}

absl::StatusOr<std::string_view> OpenSealedBytes(std::string_view what,
                                                 std::string_view magic,
                                                 uint32_t version,
                                                 std::string_view bytes) {
  ByteReader reader(bytes, what);
  ARGMESH_ASSIGN_OR_RETURN(const std::string_view found_magic,
                           reader.ReadBytes(4));
  if (found_magic != magic) {
    return absl::DataLossError(
        absl::StrFormat("%s: wrong magic", std::string(what)));
  }
  ARGMESH_ASSIGN_OR_RETURN(const uint32_t found_version, reader.ReadU32());
  ARGMESH_ASSIGN_OR_RETURN(const uint64_t length, reader.ReadU64());
  ARGMESH_ASSIGN_OR_RETURN(const uint32_t checksum, reader.ReadU32());
  if (length != reader.remaining()) {
    return absl::DataLossError(
        absl::StrFormat("%s: %d bytes announced, %d there", std::string(what),
                        length, reader.remaining()));
  }
  const std::string_view payload = bytes.substr(kSealBytes);
  if (Checksum(bytes.substr(0, kSealBytes - 4), payload) != checksum) {
    return absl::DataLossError(
        absl::StrFormat("%s: checksum does not match", std::string(what)));
  }
  // After the checksum: a damaged version is damage.
  if (found_version != version) {
    return absl::FailedPreconditionError(
        absl::StrFormat("%s: version %d, this program reads version %d",
                        std::string(what), found_version, version));
  }
  return payload;
}

}  // namespace argmesh
