#include "core/mesh/mesh_obj.h"

#include <algorithm>
#include <array>
#include <limits>
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

// Statements that say nothing about the shape of the surface.
constexpr std::array<std::string_view, 9> kPassedOver = {
    "vt", "vn", "vp", "g", "o", "s", "usemtl", "mtllib", "usemap"};

bool IsPassedOver(std::string_view statement) {
  return std::find(kPassedOver.begin(), kPassedOver.end(), statement) !=
         kPassedOver.end();
}

TextScannerOptions ObjText(const MeshLimits& limits) {
  return {.format_name = "OBJ",
          .hash_comments = true,
          .continuations = true,
          .max_line_bytes = limits.max_line_bytes};
}

// "", "7", "7/", "7/-2", "/3": what may follow the slash of a face corner.
bool IsCornerTail(std::string_view tail) {
  for (int part = 0; part < 2; ++part) {
    const size_t slash = tail.find('/');
    const std::string_view index = tail.substr(0, slash);
    if (!index.empty() && !ParseInteger(index)) return false;
    if (slash == std::string_view::npos) return true;
    tail.remove_prefix(slash + 1);
  }
  return false;
}

class ObjParser {
 public:
  ObjParser(std::string_view bytes, const MeshLimits& limits)
      : scanner_(bytes, ObjText(limits)), assembly_(limits, bytes.size()) {}

  absl::StatusOr<ParsedMesh> Parse() &&;

 private:
  absl::Status ParseStatement(std::string_view statement);
  absl::Status ParseVertex();
  absl::Status ParseFace();
  absl::StatusOr<int32_t> ParseCorner(std::string_view word);

  TextScanner scanner_;
  MeshAssembly assembly_;
  int64_t num_faces_ = 0;
  std::vector<int32_t> corners_;
  // The largest vertex named so far and where, for the check at the end.
  int64_t largest_index_ = -1;
  int64_t largest_index_face_ = 0;
  int64_t largest_index_line_ = 0;
};

absl::Status ObjParser::ParseVertex() {
  std::array<double, 3> position = {0, 0, 0};
  for (double& coordinate : position) {
    const std::string_view word = scanner_.NextOnLine();
    const std::optional<double> value = ParseCoordinate(word);
    if (!value) {
      return scanner_.BadNumber(
          absl::StrFormat("vertex %d", assembly_.num_vertices() + 1), word);
    }
    coordinate = *value;
  }
  return scanner_.Located(
      assembly_.AddVertex(position[0], position[1], position[2]));
}

// The vertex of "7", "7/1", "7//2" or "7/1/2", counted from 0.
absl::StatusOr<int32_t> ObjParser::ParseCorner(std::string_view word) {
  const size_t slash = word.find('/');
  const std::string_view index_word = word.substr(0, slash);
  const std::optional<int64_t> index = ParseInteger(index_word);
  if (!index || (slash != std::string_view::npos &&
                 !IsCornerTail(word.substr(slash + 1)))) {
    return scanner_.Malformed(absl::StrFormat("face %d: %s is no vertex",
                                              num_faces_, QuoteWord(word)));
  }
  const int64_t known = assembly_.num_vertices();
  if (*index == 0 || *index < -known ||
      *index > std::numeric_limits<int32_t>::max()) {
    return scanner_.Malformed(
        absl::StrFormat("face %d: vertex %d of %d", num_faces_, *index, known));
  }
  return static_cast<int32_t>(*index < 0 ? known + *index : *index - 1);
}

absl::Status ObjParser::ParseFace() {
  ++num_faces_;
  corners_.clear();
  for (std::string_view word = scanner_.NextOnLine(); !word.empty();
       word = scanner_.NextOnLine()) {
    ARGMESH_ASSIGN_OR_RETURN(const int32_t vertex, ParseCorner(word));
    corners_.push_back(vertex);
    if (vertex > largest_index_) {
      largest_index_ = vertex;
      largest_index_face_ = num_faces_;
      largest_index_line_ = scanner_.line();
    }
  }
  return scanner_.Located(assembly_.AddPolygon(corners_));
}

absl::Status ObjParser::ParseStatement(std::string_view statement) {
  if (statement == "v") return ParseVertex();
  if (statement == "f" || statement == "fo") return ParseFace();
  if (!IsPassedOver(statement)) assembly_.CountIgnoredStatements(1);
  return absl::OkStatus();
}

absl::StatusOr<ParsedMesh> ObjParser::Parse() && {
  do {
    const std::string_view statement = scanner_.NextOnLine();
    if (statement.empty()) continue;
    ARGMESH_RETURN_IF_ERROR(ParseStatement(statement));
  } while (scanner_.NextLine());
  ARGMESH_RETURN_IF_ERROR(scanner_.status());
  if (largest_index_ >= assembly_.num_vertices()) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "OBJ line %d: face %d: vertex %d of %d", largest_index_line_,
        largest_index_face_, largest_index_ + 1, assembly_.num_vertices()));
  }
  absl::StatusOr<ParsedMesh> parsed =
      std::move(assembly_).Finish(MeshFormat::kObj);
  if (!parsed.ok()) return scanner_.Located(parsed.status());
  return parsed;
}

}  // namespace

bool LooksLikeObj(std::string_view bytes) {
  TextScanner scanner(bytes, ObjText(MeshLimits{}));
  const std::string_view statement = scanner.Next();
  return statement == "v" || statement == "f" || IsPassedOver(statement);
}

absl::StatusOr<ParsedMesh> ParseObj(std::string_view bytes,
                                    const MeshLimits& limits) {
  return ObjParser(bytes, limits).Parse();
}

}  // namespace argmesh
