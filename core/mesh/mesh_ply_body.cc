#include "core/mesh/mesh_ply_body.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <optional>
#include <string>

#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

static_assert(std::endian::native == std::endian::little);

struct IntegerRange {
  int64_t smallest;
  int64_t largest;
};

template <typename T>
constexpr IntegerRange RangeOf() {
  return {std::numeric_limits<T>::min(), std::numeric_limits<T>::max()};
}

IntegerRange RangeOfScalar(PlyScalar type) {
  switch (type) {
    case PlyScalar::kInt8:
      return RangeOf<int8_t>();
    case PlyScalar::kUint8:
      return RangeOf<uint8_t>();
    case PlyScalar::kInt16:
      return RangeOf<int16_t>();
    case PlyScalar::kUint16:
      return RangeOf<uint16_t>();
    case PlyScalar::kInt32:
      return RangeOf<int32_t>();
    case PlyScalar::kUint32:
      return RangeOf<uint32_t>();
    case PlyScalar::kFloat32:
    case PlyScalar::kFloat64:
      break;
  }
  return {0, -1};
}

}  // namespace

PlyTextSource::PlyTextSource(std::string_view bytes, const PlyHeader& header,
                             const MeshLimits& limits)
    : scanner_(bytes.substr(header.body_offset),
               {.format_name = "PLY",
                .hash_comments = false,
                .continuations = false,
                .max_line_bytes = limits.max_line_bytes,
                .first_line = header.body_line}) {}

absl::StatusOr<double> PlyTextSource::ReadCoordinate(PlyScalar /*type*/) {
  const std::string_view word = scanner_.Next();
  const std::optional<double> value = ParseCoordinate(word);
  if (!value) return scanner_.BadNumber("coordinate", word);
  return *value;
}

absl::StatusOr<int64_t> PlyTextSource::ReadInteger(PlyScalar type) {
  const std::string_view word = scanner_.Next();
  const std::optional<int64_t> value = ParseInteger(word);
  if (!value) return scanner_.BadNumber("whole number", word);
  const IntegerRange range = RangeOfScalar(type);
  if (*value < range.smallest || *value > range.largest) {
    return scanner_.Malformed(
        absl::StrFormat("%d is outside the range %d to %d of its type", *value,
                        range.smallest, range.largest));
  }
  return *value;
}

absl::Status PlyTextSource::Skip(PlyScalar /*type*/, int64_t count) {
  for (int64_t i = 0; i < count; ++i) {
    const std::string_view word = scanner_.Next();
    if (word.empty()) return scanner_.BadNumber("value", word);
  }
  return absl::OkStatus();
}

absl::Status PlyTextSource::EndItem() {
  if (!scanner_.AtLineEnd()) ++lines_with_more_;
  scanner_.NextLine();
  return scanner_.status();
}

absl::Status PlyTextSource::ExpectEnd() {
  if (scanner_.AtEnd()) return scanner_.status();
  return scanner_.Malformed("more lines than the header declares");
}

PlyBinarySource::PlyBinarySource(std::string_view bytes,
                                 const PlyHeader& header)
    : bytes_(bytes),
      position_(header.body_offset),
      swap_(header.encoding == PlyEncoding::kBigEndian) {}

absl::Status PlyBinarySource::Located(const absl::Status& status) const {
  if (status.ok()) return status;
  return absl::Status(status.code(),
                      absl::StrFormat("PLY byte %d: %s", position_,
                                      std::string(status.message())));
}

absl::Status PlyBinarySource::Malformed(std::string_view message) const {
  return Located(absl::InvalidArgumentError(std::string(message)));
}

absl::Status PlyBinarySource::Need(int64_t count) const {
  if (count <= BytesLeft()) return absl::OkStatus();
  return Malformed(
      absl::StrFormat("%d bytes needed, %d are left", count, BytesLeft()));
}

// The bytes are there.
template <typename T>
T PlyBinarySource::Take() {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), bytes_.data() + position_, sizeof(T));
  if (swap_) std::reverse(raw.begin(), raw.end());
  position_ += sizeof(T);
  return std::bit_cast<T>(raw);
}

absl::StatusOr<double> PlyBinarySource::ReadCoordinate(PlyScalar type) {
  double value = 0;
  if (IsPlyInteger(type)) {
    ARGMESH_ASSIGN_OR_RETURN(const int64_t whole, ReadInteger(type));
    value = static_cast<double>(whole);
  } else {
    ARGMESH_RETURN_IF_ERROR(Need(MinBytes(type)));
    value = type == PlyScalar::kFloat32 ? static_cast<double>(Take<float>())
                                        : Take<double>();
  }
  if (IsCoordinate(value)) return value;
  position_ -= PlyScalarBytes(type);
  return Malformed(absl::StrFormat(
      "coordinate: %g is not finite or beyond the range of float", value));
}

absl::StatusOr<int64_t> PlyBinarySource::ReadInteger(PlyScalar type) {
  ARGMESH_RETURN_IF_ERROR(Need(MinBytes(type)));
  switch (type) {
    case PlyScalar::kInt8:
      return Take<int8_t>();
    case PlyScalar::kUint8:
      return Take<uint8_t>();
    case PlyScalar::kInt16:
      return Take<int16_t>();
    case PlyScalar::kUint16:
      return Take<uint16_t>();
    case PlyScalar::kInt32:
      return Take<int32_t>();
    case PlyScalar::kUint32:
      return Take<uint32_t>();
    case PlyScalar::kFloat32:
    case PlyScalar::kFloat64:
      break;
  }
  return absl::InternalError("a PLY whole number of a floating-point type");
}

// The caller has checked that count * MinBytes is no more than BytesLeft().
absl::Status PlyBinarySource::Skip(PlyScalar type, int64_t count) {
  ARGMESH_RETURN_IF_ERROR(Need(count * MinBytes(type)));
  position_ += static_cast<size_t>(count) * PlyScalarBytes(type);
  return absl::OkStatus();
}

absl::Status PlyBinarySource::ExpectEnd() const {
  if (BytesLeft() == 0) return absl::OkStatus();
  return Malformed(
      absl::StrFormat("%d bytes more than the header declares", BytesLeft()));
}

}  // namespace argmesh
