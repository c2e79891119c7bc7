#include "core/base/byte_reader.h"

#include <bit>
#include <cstring>
#include <string>

#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"

namespace argmesh {

static_assert(std::endian::native == std::endian::little,
              "stored formats are little-endian");

ByteReader::ByteReader(std::string_view bytes, std::string_view what)
    : bytes_(bytes), what_(what) {}

absl::Status ByteReader::Need(size_t count) const {
  if (count <= remaining()) return absl::OkStatus();
  return absl::DataLossError(
      absl::StrFormat("%s: %d bytes needed at offset %d, %d left",
                      std::string(what_), count, position_, remaining()));
}

template <typename T>
absl::StatusOr<T> ByteReader::ReadScalar() {
  ARGMESH_RETURN_IF_ERROR(Need(sizeof(T)));
  T value;
  std::memcpy(&value, bytes_.data() + position_, sizeof(T));
  position_ += sizeof(T);
  return value;
}

absl::StatusOr<uint8_t> ByteReader::ReadU8() { return ReadScalar<uint8_t>(); }
absl::StatusOr<uint16_t> ByteReader::ReadU16() {
  return ReadScalar<uint16_t>();
}
absl::StatusOr<uint32_t> ByteReader::ReadU32() {
  return ReadScalar<uint32_t>();
}
absl::StatusOr<uint64_t> ByteReader::ReadU64() {
  return ReadScalar<uint64_t>();
}
absl::StatusOr<float> ByteReader::ReadF32() { return ReadScalar<float>(); }
absl::StatusOr<double> ByteReader::ReadF64() { return ReadScalar<double>(); }

absl::StatusOr<uint32_t> ByteReader::ReadCount(size_t item_bytes) {
  const size_t at = position_;
  ARGMESH_ASSIGN_OR_RETURN(const uint32_t count, ReadU32());
  if (item_bytes > 0 && count > remaining() / item_bytes) {
    return absl::DataLossError(absl::StrFormat(
        "%s: count %d at offset %d needs %d bytes each, %d left",
        std::string(what_), count, at, item_bytes, remaining()));
  }
  return count;
}

absl::StatusOr<std::vector<float>> ByteReader::ReadF32Array(size_t count) {
  if (count > remaining() / sizeof(float)) return Need(remaining() + 1);
  std::vector<float> values(count);
  if (count > 0) {
    std::memcpy(values.data(), bytes_.data() + position_,
                count * sizeof(float));
  }
  position_ += count * sizeof(float);
  return values;
}

absl::StatusOr<std::string_view> ByteReader::ReadBytes(size_t count) {
  ARGMESH_RETURN_IF_ERROR(Need(count));
  const std::string_view bytes = bytes_.substr(position_, count);
  position_ += count;
  return bytes;
}

absl::Status ByteReader::ExpectEnd() const {
  if (remaining() == 0) return absl::OkStatus();
  return absl::DataLossError(
      absl::StrFormat("%s: %d bytes left over at offset %d", std::string(what_),
                      remaining(), position_));
}

}  // namespace argmesh
