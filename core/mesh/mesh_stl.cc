#include "core/mesh/mesh_stl.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "core/mesh/mesh_assembly.h"
#include "core/mesh/text_scanner.h"
#include "core/mesh/vertex_weld.h"

namespace argmesh {
namespace {

constexpr size_t kCountOffset = 80;
constexpr size_t kFacetOffset = 84;
constexpr size_t kFacetBytes = 50;
constexpr size_t kNormalBytes = 12;

// Facets of three corners each, and those that had fewer.
struct FacetList {
  std::vector<double> coordinates;
  std::vector<uint8_t> valences;  // 3, or 0 for a facet to skip

  int64_t num_facets() const { return static_cast<int64_t>(valences.size()); }
};

uint32_t BinaryFacetCount(std::string_view bytes) {
  uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kCountOffset, sizeof(count));
  return count;
}

// The corners' indices are 32 bits wide.
absl::Status CheckFacetCount(int64_t count, const MeshLimits& limits) {
  const int64_t limit = std::min<int64_t>(
      limits.max_faces, std::numeric_limits<int32_t>::max() / 3);
  if (count <= limit) return absl::OkStatus();
  return absl::ResourceExhaustedError(
      absl::StrFormat("%d facets, at most %d", count, limit));
}

absl::StatusOr<FacetList> ReadBinaryFacets(std::string_view bytes,
                                           const MeshLimits& limits) {
  const size_t count = BinaryFacetCount(bytes);
  if (const absl::Status status =
          CheckFacetCount(static_cast<int64_t>(count), limits);
      !status.ok()) {
    return absl::Status(status.code(),
                        absl::StrFormat("STL byte %d: %s", kCountOffset,
                                        std::string(status.message())));
  }
  FacetList facets;
  facets.valences.assign(count, 3);
  facets.coordinates.reserve(9 * count);
  for (size_t facet = 0; facet < count; ++facet) {
    const size_t at = kFacetOffset + facet * kFacetBytes + kNormalBytes;
    std::array<float, 9> corners;
    std::memcpy(corners.data(), bytes.data() + at, sizeof(corners));
    for (size_t i = 0; i < corners.size(); ++i) {
      const auto value = static_cast<double>(corners[i]);
      if (!IsCoordinate(value)) {
        return absl::InvalidArgumentError(absl::StrFormat(
            "STL byte %d: facet %d: coordinate %g is not finite",
            at + i * sizeof(float), facet, value));
      }
      facets.coordinates.push_back(value);
    }
  }
  return facets;
}

class AsciiStlParser {
 public:
  AsciiStlParser(std::string_view bytes, const MeshLimits& limits)
      : scanner_(bytes, {.format_name = "STL",
                         .hash_comments = false,
                         .continuations = false,
                         .max_line_bytes = limits.max_line_bytes}),
        limits_(limits) {}

  absl::StatusOr<FacetList> Parse() &&;

 private:
  absl::Status ParseSolid();
  absl::Status ParseFacet();
  absl::StatusOr<int> ParseLoop();
  absl::Status ParseVertex();
  absl::Status Expect(std::string_view keyword);

  TextScanner scanner_;
  MeshLimits limits_;
  FacetList facets_;
};

absl::Status AsciiStlParser::Expect(std::string_view keyword) {
  const std::string_view word = scanner_.Next();
  if (LowerCase(word.substr(0, keyword.size() + 1)) == keyword) {
    return absl::OkStatus();
  }
  return scanner_.Malformed(
      absl::StrFormat("facet %d: %s where %s is expected", facets_.num_facets(),
                      word.empty() ? "the end of the bytes" : QuoteWord(word),
                      std::string(keyword)));
}

absl::Status AsciiStlParser::ParseVertex() {
  for (int i = 0; i < 3; ++i) {
    const std::string_view word = scanner_.Next();
    const std::optional<double> value = ParseCoordinate(word);
    if (!value) {
      return scanner_.BadNumber(
          absl::StrFormat("facet %d", facets_.num_facets()), word);
    }
    facets_.coordinates.push_back(*value);
  }
  return absl::OkStatus();
}

// After "loop": the corners and "endloop". Gives their number.
absl::StatusOr<int> AsciiStlParser::ParseLoop() {
  int corners = 0;
  std::string word = LowerCase(scanner_.Next());
  for (; word == "vertex"; word = LowerCase(scanner_.Next())) {
    if (++corners > 3) {
      return scanner_.Malformed(absl::StrFormat(
          "facet %d: more than 3 vertices", facets_.num_facets()));
    }
    ARGMESH_RETURN_IF_ERROR(ParseVertex());
  }
  if (word == "endloop") return corners;
  return scanner_.Malformed(absl::StrFormat(
      "facet %d: %s where vertex or endloop is expected", facets_.num_facets(),
      word.empty() ? "the end of the bytes" : QuoteWord(word)));
}

// After "facet": normal x y z, outer loop, the corners, endloop, endfacet.
absl::Status AsciiStlParser::ParseFacet() {
  ARGMESH_RETURN_IF_ERROR(Expect("normal"));
  for (int i = 0; i < 3; ++i) scanner_.Next();
  ARGMESH_RETURN_IF_ERROR(Expect("outer"));
  ARGMESH_RETURN_IF_ERROR(Expect("loop"));
  ARGMESH_ASSIGN_OR_RETURN(const int corners, ParseLoop());
  ARGMESH_RETURN_IF_ERROR(Expect("endfacet"));
  if (corners < 3) {
    facets_.coordinates.resize(facets_.coordinates.size() -
                               3 * static_cast<size_t>(corners));
  }
  facets_.valences.push_back(corners < 3 ? 0 : 3);
  return scanner_.Located(CheckFacetCount(facets_.num_facets(), limits_));
}

// After "solid": the rest of the line is its name.
absl::Status AsciiStlParser::ParseSolid() {
  scanner_.NextLine();
  while (true) {
    const std::string word = LowerCase(scanner_.Next().substr(0, 9));
    if (word == "endsolid") break;
    if (word != "facet") {
      return scanner_.Malformed(absl::StrFormat(
          "facet %d: %s where facet or endsolid is expected",
          facets_.num_facets(),
          word.empty() ? "the end of the bytes" : QuoteWord(word)));
    }
    ARGMESH_RETURN_IF_ERROR(ParseFacet());
  }
  scanner_.NextLine();
  return absl::OkStatus();
}

absl::StatusOr<FacetList> AsciiStlParser::Parse() && {
  while (!scanner_.AtEnd()) {
    ARGMESH_RETURN_IF_ERROR(Expect("solid"));
    ARGMESH_RETURN_IF_ERROR(ParseSolid());
  }
  ARGMESH_RETURN_IF_ERROR(scanner_.status());
  return std::move(facets_);
}

absl::StatusOr<ParsedMesh> WeldFacets(FacetList facets,
                                      const MeshLimits& limits,
                                      size_t file_bytes) {
  const VertexWeld weld = WeldEqualPositions(facets.coordinates);
  MeshAssembly assembly(limits, file_bytes);
  ARGMESH_RETURN_IF_ERROR(assembly.CheckVertexCount(weld.num_vertices));
  assembly.ReserveVertices(weld.num_vertices);
  for (size_t i = 0; i < weld.vertex_of.size(); ++i) {
    if (weld.vertex_of[i] < assembly.num_vertices()) continue;
    const double* position = &facets.coordinates[3 * i];
    ARGMESH_RETURN_IF_ERROR(
        assembly.AddVertex(position[0], position[1], position[2]));
  }
  facets.coordinates = {};
  std::span<const int32_t> corners = weld.vertex_of;
  for (const uint8_t valence : facets.valences) {
    ARGMESH_RETURN_IF_ERROR(assembly.AddPolygon(corners.first(valence)));
    corners = corners.subspan(valence);
  }
  absl::StatusOr<ParsedMesh> parsed =
      std::move(assembly).Finish(MeshFormat::kStl);
  if (parsed.ok()) return parsed;
  return absl::Status(
      parsed.status().code(),
      absl::StrFormat("STL: %s", std::string(parsed.status().message())));
}

}  // namespace

bool LooksLikeBinaryStl(std::string_view bytes) {
  return bytes.size() >= kFacetOffset &&
         (bytes.size() - kFacetOffset) % kFacetBytes == 0 &&
         (bytes.size() - kFacetOffset) / kFacetBytes == BinaryFacetCount(bytes);
}

bool LooksLikeAsciiStl(std::string_view bytes) {
  constexpr size_t kLooked = 512;
  TextScanner scanner(bytes.substr(0, kLooked),
                      {.format_name = "STL", .hash_comments = false});
  return LowerCase(scanner.Next()) == "solid" &&
         bytes.substr(0, kLooked).find('\0') == std::string_view::npos;
}

absl::StatusOr<ParsedMesh> ParseStl(std::string_view bytes,
                                    const MeshLimits& limits) {
  if (LooksLikeBinaryStl(bytes)) {
    ARGMESH_ASSIGN_OR_RETURN(FacetList facets, ReadBinaryFacets(bytes, limits));
    return WeldFacets(std::move(facets), limits, bytes.size());
  }
  if (LooksLikeAsciiStl(bytes)) {
    ARGMESH_ASSIGN_OR_RETURN(FacetList facets,
                             AsciiStlParser(bytes, limits).Parse());
    return WeldFacets(std::move(facets), limits, bytes.size());
  }
  if (bytes.size() < kFacetOffset) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "STL: %d bytes that do not begin with \"solid\"; a binary header alone "
        "has %d",
        bytes.size(), kFacetOffset));
  }
  const int64_t count = BinaryFacetCount(bytes);
  return absl::InvalidArgumentError(absl::StrFormat(
      "STL byte %d: %d facets take %d bytes, the file has %d (and does not "
      "begin with \"solid\")",
      kCountOffset, count,
      static_cast<int64_t>(kFacetOffset) +
          count * static_cast<int64_t>(kFacetBytes),
      bytes.size()));
}

}  // namespace argmesh
