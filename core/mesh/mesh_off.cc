#include "core/mesh/mesh_off.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "core/mesh/mesh_assembly.h"
#include "core/mesh/text_scanner.h"

namespace argmesh {
namespace {

// "0 0 0" and a blank; "0" and a blank.
constexpr int64_t kMinVertexBytes = 6;
constexpr int64_t kMinFaceBytes = 2;

// The first word of the file: [ST][C][N][4][n]OFF[count].
struct OffWord {
  bool has_texture = false;
  bool has_color = false;
  bool has_normal = false;
  bool has_fourth = false;
  bool has_dimension = false;
  std::string_view count;

  // Numbers of one vertex that must be there; colours may have a fourth.
  int NumbersPerVertex() const {
    return 3 + (has_normal ? 3 : 0) + (has_color ? 3 : 0) +
           (has_texture ? 2 : 0);
  }
};

bool TakePrefix(std::string_view& word, std::string_view prefix) {
  if (word.substr(0, prefix.size()) != prefix) return false;
  word.remove_prefix(prefix.size());
  return true;
}

std::optional<OffWord> ParseOffWord(std::string_view word) {
  OffWord off;
  off.has_texture = TakePrefix(word, "ST");
  off.has_color = TakePrefix(word, "C");
  off.has_normal = TakePrefix(word, "N");
  off.has_fourth = TakePrefix(word, "4");
  off.has_dimension = TakePrefix(word, "n");
  if (!TakePrefix(word, "OFF") && !TakePrefix(word, "off")) {
    return std::nullopt;
  }
  off.count = word;
  if (!word.empty() && !ParseInteger(word)) return std::nullopt;
  return off;
}

TextScannerOptions OffText(const MeshLimits& limits) {
  return {.format_name = "OFF",
          .hash_comments = true,
          .continuations = false,
          .max_line_bytes = limits.max_line_bytes};
}

class OffParser {
 public:
  OffParser(std::string_view bytes, const MeshLimits& limits)
      : scanner_(bytes, OffText(limits)), assembly_(limits, bytes.size()) {}

  absl::StatusOr<ParsedMesh> Parse() &&;

 private:
  absl::Status ParseHeader();
  absl::Status ParseCounts(std::string_view first);
  absl::StatusOr<int64_t> ParseCount(std::string_view subject,
                                     std::string_view word);
  absl::Status CheckCounts();
  absl::Status ParseVertex(int64_t vertex);
  absl::Status ParseFace(int64_t face);

  TextScanner scanner_;
  MeshAssembly assembly_;
  OffWord word_;
  int64_t num_vertices_ = 0;
  int64_t num_faces_ = 0;
  std::vector<int32_t> corners_;
};

absl::Status OffParser::ParseHeader() {
  std::string_view word = scanner_.Next();
  if (word.empty()) return scanner_.Malformed("no header");
  if (ParseInteger(word)) return ParseCounts(word);
  const std::optional<OffWord> off = ParseOffWord(word);
  if (!off) {
    return scanner_.Malformed(
        absl::StrFormat("%s where OFF is expected", QuoteWord(word)));
  }
  if (off->has_fourth || off->has_dimension) {
    return scanner_.Malformed(absl::StrFormat(
        "%s: only three dimensions are supported", QuoteWord(word)));
  }
  word_ = *off;
  word = off->count.empty() ? scanner_.Next() : off->count;
  if (word == "BINARY") {
    return scanner_.Malformed("OFF BINARY is not supported, only text");
  }
  return ParseCounts(word);
}

absl::StatusOr<int64_t> OffParser::ParseCount(std::string_view subject,
                                              std::string_view word) {
  const std::optional<int64_t> count = ParseInteger(word);
  if (!count) return scanner_.BadNumber(subject, word);
  if (*count < 0) {
    return scanner_.Malformed(
        absl::StrFormat("%s: %d is negative", std::string(subject), *count));
  }
  return *count;
}

// Vertices, faces and, if they are there, edges: the rest of this line.
absl::Status OffParser::ParseCounts(std::string_view first) {
  ARGMESH_ASSIGN_OR_RETURN(num_vertices_,
                           ParseCount("number of vertices", first));
  ARGMESH_ASSIGN_OR_RETURN(num_faces_,
                           ParseCount("number of faces", scanner_.Next()));
  const std::string_view edges = scanner_.NextOnLine();
  if (!edges.empty() && !ParseInteger(edges)) {
    return scanner_.BadNumber("number of edges", edges);
  }
  if (!scanner_.AtLineEnd()) {
    return scanner_.Malformed(
        "more than the numbers of vertices, faces and edges on one line");
  }
  return CheckCounts();
}

absl::Status OffParser::CheckCounts() {
  ARGMESH_RETURN_IF_ERROR(
      scanner_.Located(assembly_.CheckVertexCount(num_vertices_)));
  ARGMESH_RETURN_IF_ERROR(
      scanner_.Located(assembly_.CheckFaceCount(num_faces_)));
  // Both are below 2^31 by now. The last line may lack its end.
  const int64_t needed =
      num_vertices_ * kMinVertexBytes + num_faces_ * kMinFaceBytes;
  const auto left = static_cast<int64_t>(scanner_.remaining());
  if (needed > left + 1) {
    return scanner_.Malformed(absl::StrFormat(
        "%d vertices and %d faces take at least %d bytes, %d are left",
        num_vertices_, num_faces_, needed, left));
  }
  assembly_.ReserveVertices(num_vertices_);
  return absl::OkStatus();
}

absl::Status OffParser::ParseVertex(int64_t vertex) {
  std::array<double, 3> position = {0, 0, 0};
  const int numbers = word_.NumbersPerVertex();
  for (int i = 0; i < numbers; ++i) {
    const std::string_view word = scanner_.Next();
    if (i >= 3) {
      if (!word.empty()) continue;
      return scanner_.BadNumber(absl::StrFormat("vertex %d", vertex), word);
    }
    const std::optional<double> coordinate = ParseCoordinate(word);
    if (!coordinate) {
      return scanner_.BadNumber(absl::StrFormat("vertex %d", vertex), word);
    }
    position[static_cast<size_t>(i)] = *coordinate;
  }
  ARGMESH_RETURN_IF_ERROR(scanner_.Located(
      assembly_.AddVertex(position[0], position[1], position[2])));
  scanner_.NextLine();
  return absl::OkStatus();
}

absl::Status OffParser::ParseFace(int64_t face) {
  const auto subject = [&] { return absl::StrFormat("face %d", face); };
  const std::string_view word = scanner_.Next();
  const std::optional<int64_t> valence = ParseInteger(word);
  if (!valence) return scanner_.BadNumber(subject(), word);
  if (*valence < 0) {
    return scanner_.Malformed(
        absl::StrFormat("face %d: %d vertices", face, *valence));
  }
  ARGMESH_RETURN_IF_ERROR(scanner_.Located(assembly_.CheckValence(*valence)));
  corners_.clear();
  for (int64_t i = 0; i < *valence; ++i) {
    const std::string_view index_word = scanner_.Next();
    const std::optional<int64_t> index = ParseInteger(index_word);
    if (!index) return scanner_.BadNumber(subject(), index_word);
    if (*index < 0 || *index >= num_vertices_) {
      return scanner_.Malformed(absl::StrFormat("face %d: vertex %d of %d",
                                                face, *index, num_vertices_));
    }
    corners_.push_back(static_cast<int32_t>(*index));
  }
  ARGMESH_RETURN_IF_ERROR(scanner_.Located(assembly_.AddPolygon(corners_)));
  scanner_.NextLine();
  return absl::OkStatus();
}

absl::StatusOr<ParsedMesh> OffParser::Parse() && {
  ARGMESH_RETURN_IF_ERROR(ParseHeader());
  scanner_.NextLine();
  for (int64_t v = 0; v < num_vertices_; ++v) {
    ARGMESH_RETURN_IF_ERROR(ParseVertex(v));
  }
  for (int64_t f = 0; f < num_faces_; ++f) {
    ARGMESH_RETURN_IF_ERROR(ParseFace(f));
  }
  if (!scanner_.AtEnd()) {
    return scanner_.Malformed(
        absl::StrFormat("more than the declared %d vertices and %d faces",
                        num_vertices_, num_faces_));
  }
  ARGMESH_RETURN_IF_ERROR(scanner_.status());
  absl::StatusOr<ParsedMesh> parsed =
      std::move(assembly_).Finish(MeshFormat::kOff);
  if (!parsed.ok()) return scanner_.Located(parsed.status());
  return parsed;
}

}  // namespace

bool LooksLikeOff(std::string_view bytes) {
  TextScanner scanner(bytes, OffText(MeshLimits{}));
  const std::string_view word = scanner.Next();
  return ParseInteger(word) || ParseOffWord(word);
}

absl::StatusOr<ParsedMesh> ParseOff(std::string_view bytes,
                                    const MeshLimits& limits) {
  return OffParser(bytes, limits).Parse();
}

}  // namespace argmesh
