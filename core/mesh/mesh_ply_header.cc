#include "core/mesh/mesh_ply_header.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "core/mesh/text_scanner.h"

namespace argmesh {
namespace {

struct NamedScalar {
  std::string_view name;
  PlyScalar type;
};

constexpr std::array<NamedScalar, 16> kScalars = {{
    {"char", PlyScalar::kInt8},
    {"uchar", PlyScalar::kUint8},
    {"short", PlyScalar::kInt16},
    {"ushort", PlyScalar::kUint16},
    {"int", PlyScalar::kInt32},
    {"uint", PlyScalar::kUint32},
    {"float", PlyScalar::kFloat32},
    {"double", PlyScalar::kFloat64},
    {"int8", PlyScalar::kInt8},
    {"uint8", PlyScalar::kUint8},
    {"int16", PlyScalar::kInt16},
    {"uint16", PlyScalar::kUint16},
    {"int32", PlyScalar::kInt32},
    {"uint32", PlyScalar::kUint32},
    {"float32", PlyScalar::kFloat32},
    {"float64", PlyScalar::kFloat64},
}};

class PlyHeaderParser {
 public:
  PlyHeaderParser(std::string_view bytes, const MeshLimits& limits)
      : bytes_(bytes),
        scanner_(bytes, {.format_name = "PLY",
                         .hash_comments = false,
                         .continuations = false,
                         .max_line_bytes = limits.max_line_bytes}) {}

  absl::StatusOr<PlyHeader> Parse() &&;

 private:
  absl::Status ParseLines();
  absl::Status ParseLine(std::string_view keyword);
  absl::Status ParseFormat();
  absl::Status ParseElement();
  absl::Status ParseProperty();
  absl::StatusOr<PlyScalar> ParseScalar(std::string_view word);
  absl::Status CheckElements();
  absl::Status FindBody();

  std::string_view bytes_;
  TextScanner scanner_;
  bool has_format_ = false;
  PlyHeader header_;
};

absl::Status PlyHeaderParser::ParseFormat() {
  const std::string_view encoding = scanner_.NextOnLine();
  if (encoding == "ascii") {
    header_.encoding = PlyEncoding::kAscii;
  } else if (encoding == "binary_little_endian") {
    header_.encoding = PlyEncoding::kLittleEndian;
  } else if (encoding == "binary_big_endian") {
    header_.encoding = PlyEncoding::kBigEndian;
  } else {
    return scanner_.Malformed(
        absl::StrFormat("format %s is unknown", QuoteWord(encoding)));
  }
  const std::string_view version = scanner_.NextOnLine();
  if (version != "1.0") {
    return scanner_.Malformed(
        absl::StrFormat("version %s is unknown, not 1.0", QuoteWord(version)));
  }
  has_format_ = true;
  return absl::OkStatus();
}

absl::Status PlyHeaderParser::ParseElement() {
  PlyElement element;
  element.name = scanner_.NextOnLine();
  const std::string_view word = scanner_.NextOnLine();
  const std::optional<int64_t> count = ParseInteger(word);
  const std::string subject = "element " + QuoteWord(element.name);
  if (!count) return scanner_.BadNumber(subject, word);
  if (*count < 0) {
    return scanner_.Malformed(
        absl::StrFormat("%s: count %d is negative", subject, *count));
  }
  element.count = *count;
  header_.elements.push_back(std::move(element));
  return absl::OkStatus();
}

absl::StatusOr<PlyScalar> PlyHeaderParser::ParseScalar(std::string_view word) {
  for (const NamedScalar& scalar : kScalars) {
    if (scalar.name == word) return scalar.type;
  }
  return scanner_.Malformed(
      absl::StrFormat("type %s is unknown", QuoteWord(word)));
}

absl::Status PlyHeaderParser::ParseProperty() {
  if (header_.elements.empty()) {
    return scanner_.Malformed("property before any element");
  }
  PlyProperty property;
  std::string_view word = scanner_.NextOnLine();
  if (word == "list") {
    ARGMESH_ASSIGN_OR_RETURN(property.count_type,
                             ParseScalar(scanner_.NextOnLine()));
    if (!IsPlyInteger(*property.count_type)) {
      return scanner_.Malformed("the count of a list is not of integer type");
    }
    word = scanner_.NextOnLine();
  }
  ARGMESH_ASSIGN_OR_RETURN(property.type, ParseScalar(word));
  property.name = scanner_.NextOnLine();
  if (property.name.empty()) return scanner_.Malformed("property has no name");
  header_.elements.back().properties.push_back(property);
  return absl::OkStatus();
}

absl::Status PlyHeaderParser::ParseLine(std::string_view keyword) {
  if (keyword == "comment" || keyword == "obj_info") return absl::OkStatus();
  if (keyword == "format") return ParseFormat();
  if (keyword == "element") return ParseElement();
  if (keyword == "property") return ParseProperty();
  return scanner_.Malformed(
      absl::StrFormat("%s is no header line", QuoteWord(keyword)));
}

absl::Status PlyHeaderParser::ParseLines() {
  while (scanner_.NextLine()) {
    const std::string_view keyword = scanner_.NextOnLine();
    if (keyword == "end_header") return absl::OkStatus();
    if (keyword.empty()) continue;
    ARGMESH_RETURN_IF_ERROR(ParseLine(keyword));
  }
  return scanner_.Malformed("the bytes end before end_header");
}

absl::Status PlyHeaderParser::CheckElements() {
  for (const std::string_view name : {"vertex", "face", "tristrips"}) {
    const auto same_name = std::count_if(
        header_.elements.begin(), header_.elements.end(),
        [&](const PlyElement& element) { return element.name == name; });
    if (same_name > 1) {
      return scanner_.Malformed(
          absl::StrFormat("%d elements %s", same_name, std::string(name)));
    }
  }
  return absl::OkStatus();
}

// A binary body may begin with any byte, LF among them: after a header whose
// lines end with a lone CR, an LF belongs to the body.
absl::Status PlyHeaderParser::FindBody() {
  const bool lone_cr =
      bytes_.size() > 4 && bytes_[3] == '\r' && bytes_[4] != '\n';
  size_t at = scanner_.position();
  while (at < bytes_.size() && (bytes_[at] == ' ' || bytes_[at] == '\t')) ++at;
  if (at < bytes_.size() && bytes_[at] == '\r') {
    ++at;
    if (!lone_cr && at < bytes_.size() && bytes_[at] == '\n') ++at;
  } else if (at < bytes_.size() && bytes_[at] == '\n') {
    ++at;
  } else if (at < bytes_.size()) {
    return scanner_.Malformed("more than end_header on its line");
  }
  header_.body_offset = at;
  header_.body_line = scanner_.line() + 1;
  return absl::OkStatus();
}

absl::StatusOr<PlyHeader> PlyHeaderParser::Parse() && {
  if (scanner_.NextOnLine() != "ply" || !scanner_.AtLineEnd()) {
    return scanner_.Malformed("the first line is not \"ply\"");
  }
  ARGMESH_RETURN_IF_ERROR(ParseLines());
  if (!has_format_) return scanner_.Malformed("no format line");
  ARGMESH_RETURN_IF_ERROR(CheckElements());
  ARGMESH_RETURN_IF_ERROR(FindBody());
  return std::move(header_);
}

}  // namespace

size_t PlyScalarBytes(PlyScalar type) {
  switch (type) {
    case PlyScalar::kInt8:
    case PlyScalar::kUint8:
      return 1;
    case PlyScalar::kInt16:
    case PlyScalar::kUint16:
      return 2;
    case PlyScalar::kInt32:
    case PlyScalar::kUint32:
    case PlyScalar::kFloat32:
      return 4;
    case PlyScalar::kFloat64:
      return 8;
  }
  return 8;
}

bool IsPlyInteger(PlyScalar type) {
  return type != PlyScalar::kFloat32 && type != PlyScalar::kFloat64;
}

const PlyElement* PlyHeader::FindElement(std::string_view name) const {
  const auto found =
      std::find_if(elements.begin(), elements.end(),
                   [&](const PlyElement& e) { return e.name == name; });
  return found == elements.end() ? nullptr : &*found;
}

bool LooksLikePly(std::string_view bytes) {
  return bytes.substr(0, 3) == "ply" &&
         (bytes.size() == 3 || bytes[3] == '\n' || bytes[3] == '\r' ||
          bytes[3] == ' ' || bytes[3] == '\t');
}

absl::StatusOr<PlyHeader> ParsePlyHeader(std::string_view bytes,
                                         const MeshLimits& limits) {
  return PlyHeaderParser(bytes, limits).Parse();
}

}  // namespace argmesh
