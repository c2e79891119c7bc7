#include "core/mesh/mesh_format.h"

#include <array>
#include <string>

#include "absl/strings/str_format.h"
#include "core/mesh/mesh_obj.h"
#include "core/mesh/mesh_off.h"
#include "core/mesh/mesh_ply.h"
#include "core/mesh/mesh_ply_header.h"
#include "core/mesh/mesh_stl.h"
#include "core/mesh/text_scanner.h"

namespace argmesh {
namespace {

constexpr std::array<MeshFormat, 4> kFormats = {
    MeshFormat::kOff, MeshFormat::kObj, MeshFormat::kPly, MeshFormat::kStl};

bool BeginsWith(std::string_view bytes, std::string_view prefix) {
  return bytes.substr(0, prefix.size()) == prefix;
}

// Binary STL first: its header is free text and may say anything.
MeshFormat FormatFromBytes(std::string_view bytes) {
  if (LooksLikeBinaryStl(bytes)) return MeshFormat::kStl;
  if (LooksLikePly(bytes)) return MeshFormat::kPly;
  if (LooksLikeAsciiStl(bytes)) return MeshFormat::kStl;
  if (LooksLikeOff(bytes)) return MeshFormat::kOff;
  if (LooksLikeObj(bytes)) return MeshFormat::kObj;
  return MeshFormat::kUnknown;
}

absl::StatusOr<ParsedMesh> ParseAs(std::string_view bytes, MeshFormat format,
                                   const MeshLimits& limits) {
  switch (format) {
    case MeshFormat::kOff:
      return ParseOff(bytes, limits);
    case MeshFormat::kObj:
      return ParseObj(bytes, limits);
    case MeshFormat::kPly:
      return ParsePly(bytes, limits);
    case MeshFormat::kStl:
      return ParseStl(bytes, limits);
    case MeshFormat::kUnknown:
      break;
  }
  constexpr size_t kShown = 16;
  return absl::InvalidArgumentError(
      absl::StrFormat("byte 0: %s begins no OFF, OBJ, PLY or STL file",
                      QuoteWord(bytes.substr(0, kShown))));
}

}  // namespace

std::string_view MeshFormatName(MeshFormat format) {
  switch (format) {
    case MeshFormat::kOff:
      return "off";
    case MeshFormat::kObj:
      return "obj";
    case MeshFormat::kPly:
      return "ply";
    case MeshFormat::kStl:
      return "stl";
    case MeshFormat::kUnknown:
      break;
  }
  return "unknown";
}

MeshFormat MeshFormatFromPath(std::string_view path) {
  const size_t name = path.find_last_of('/');
  if (name != std::string_view::npos) path.remove_prefix(name + 1);
  const size_t dot = path.find_last_of('.');
  if (dot == std::string_view::npos) return MeshFormat::kUnknown;
  const std::string extension = LowerCase(path.substr(dot + 1));
  for (const MeshFormat format : kFormats) {
    if (extension == MeshFormatName(format)) return format;
  }
  return MeshFormat::kUnknown;
}

absl::StatusOr<ParsedMesh> ParseMesh(std::string_view bytes, MeshFormat format,
                                     const MeshLimits& limits) {
  if (bytes.empty()) return absl::InvalidArgumentError("byte 0: no bytes");
  if (static_cast<int64_t>(bytes.size()) > limits.max_bytes) {
    return absl::ResourceExhaustedError(absl::StrFormat(
        "%d bytes, at most %d", bytes.size(), limits.max_bytes));
  }
  if (BeginsWith(bytes, "\xFE\xFF") || BeginsWith(bytes, "\xFF\xFE")) {
    return absl::InvalidArgumentError(
        "byte 0: UTF-16 text is not supported, only UTF-8");
  }
  if (BeginsWith(bytes, "\xEF\xBB\xBF")) bytes.remove_prefix(3);
  if (format == MeshFormat::kUnknown) format = FormatFromBytes(bytes);
  return ParseAs(bytes, format, limits);
}

}  // namespace argmesh
