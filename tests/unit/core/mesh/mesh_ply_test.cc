// The PLY parser through ParseMesh.
#include "core/mesh/mesh_ply.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>

#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr auto kInvalid = absl::StatusCode::kInvalidArgument;
constexpr auto kExhausted = absl::StatusCode::kResourceExhausted;

FaceMatrix SquareFaces() {
  FaceMatrix F(2, 3);
  F << 0, 1, 2, 0, 2, 3;
  return F;
}

void ExpectSquare(const std::string& bytes) {
  for (const MeshFormat told : {MeshFormat::kPly, MeshFormat::kUnknown}) {
    ASSERT_OK_AND_ASSIGN(const ParsedMesh parsed, ParseMesh(bytes, told));
    EXPECT_EQ(parsed.format, MeshFormat::kPly);
    EXPECT_EQ(parsed.mesh.F, SquareFaces());
    ASSERT_EQ(parsed.mesh.num_vertices(), 4);
    EXPECT_EQ(parsed.mesh.vertex(2), Eigen::Vector3d(1, 1, 0));
  }
}

// A header with `vertex` and `face` properties for the square below.
std::string Header(const std::string& format,
                   const std::string& scalar = "float",
                   const std::string& list = "uchar int") {
  return "ply\nformat " + format + " 1.0\ncomment made by hand\n" +
         "element vertex 4\nproperty " + scalar + " x\nproperty " + scalar +
         " y\nproperty " + scalar + " z\nelement face 1\nproperty list " +
         list + " vertex_indices\nend_header\n";
}

const std::string kTextBody = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

template <typename T>
std::string Raw(T value, bool big_endian) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

template <typename Scalar, typename Count, typename Index>
std::string BinaryBody(bool big_endian) {
  std::string body;
  for (const int value : {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) {
    body += Raw(static_cast<Scalar>(value), big_endian);
  }
  body += Raw(static_cast<Count>(4), big_endian);
  for (const int vertex : {0, 1, 2, 3}) {
    body += Raw(static_cast<Index>(vertex), big_endian);
  }
  return body;
}

TEST(ParsePly, ReadsText) {
  ExpectSquare(Header("ascii") + kTextBody);
  ExpectSquare(Header("ascii", "double", "int uint") + kTextBody);
  ExpectSquare(Header("ascii", "int8", "int16 uint16") + kTextBody);
}

TEST(ParsePly, ReadsEveryScalarTypeInBothByteOrders) {
  for (const bool big : {false, true}) {
    const std::string format =
        big ? "binary_big_endian" : "binary_little_endian";
    ExpectSquare(Header(format, "float", "uchar int") +
                 BinaryBody<float, uint8_t, int32_t>(big));
    ExpectSquare(Header(format, "float32", "uint8 int32") +
                 BinaryBody<float, uint8_t, int32_t>(big));
    ExpectSquare(Header(format, "double", "char uint") +
                 BinaryBody<double, int8_t, uint32_t>(big));
    ExpectSquare(Header(format, "float64", "short ushort") +
                 BinaryBody<double, int16_t, uint16_t>(big));
    ExpectSquare(Header(format, "short", "ushort short") +
                 BinaryBody<int16_t, uint16_t, int16_t>(big));
    ExpectSquare(Header(format, "uint", "int uchar") +
                 BinaryBody<uint32_t, int32_t, uint8_t>(big));
    ExpectSquare(Header(format, "uint8", "uint32 int8") +
                 BinaryBody<uint8_t, uint32_t, int8_t>(big));
  }
}

std::string WithLineEnd(const std::string& text, const std::string& line_end) {
  std::string changed;
  for (const char c : text) changed += c == '\n' ? line_end : std::string(1, c);
  return changed;
}

TEST(ParsePly, TakesEveryLineEnd) {
  for (const std::string line_end : {"\r\n", "\r", "  \n"}) {
    ExpectSquare(WithLineEnd(Header("ascii") + kTextBody, line_end));
    ExpectSquare(WithLineEnd(Header("binary_little_endian"), line_end) +
                 BinaryBody<float, uint8_t, int32_t>(false));
  }
}

TEST(ParsePly, LeavesALineFeedAfterALoneCarriageReturnToTheBody) {
  const std::string header =
      "ply\rformat binary_little_endian 1.0\relement vertex 3\r"
      "property uchar x\rproperty uchar y\rproperty uchar z\relement face 1\r"
      "property list uchar uchar vertex_index\rend_header\r";
  ASSERT_OK_AND_ASSIGN(
      const ParsedMesh parsed,
      ParseMesh(header + std::string("\n\0\0\1\0\0\0\1\0\3\0\1\2", 13)));
  EXPECT_EQ(parsed.mesh.vertex(0), Eigen::Vector3d(10, 0, 0));
}

TEST(ParsePly, SkipsOtherPropertiesAndElementsInAnyOrder) {
  ASSERT_OK_AND_ASSIGN(
      const ParsedMesh parsed,
      ParseMesh("ply\nformat ascii 1.0\nobj_info x\n"
                "element face 1\nproperty list uchar float texcoord\n"
                "property uchar red\nproperty list uint uint vertex_index\n"
                "element camera 2\nproperty float x\n"
                "property list uchar double row\n"
                "element vertex 4\nproperty float z\nproperty float quality\n"
                "property float y\nproperty float x\nend_header\n"
                "2 0.5 0.5 255 4 0 1 2 3\n"
                "7 0\n7 3 1 nan 3\n"
                "0 nan 0 0\n0 1 0 1\n0 1 1 1\n0 1 1 0\n"));
  EXPECT_EQ(parsed.mesh.F, SquareFaces());
  EXPECT_EQ(parsed.mesh.vertex(1), Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(parsed.ignored_statements, 1);
}

TEST(ParsePly, CountsLinesOfMoreValuesThanDeclared) {
  ASSERT_OK_AND_ASSIGN(
      const ParsedMesh parsed,
      ParseMesh(Header("ascii") +
                "0 0 0 9 9 9\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 255 0 0\n"));
  EXPECT_EQ(parsed.mesh.F, SquareFaces());
  EXPECT_EQ(parsed.ignored_statements, 2);
}

TEST(ParsePly, ReadsTriangleStripsWithRestarts) {
  const std::string bytes =
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\n"
      "property float y\nproperty float z\nelement tristrips 1\n"
      "property list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n"
      "13 0 1 2 3 -1 0 1 -1 -1 2 3 4 -1\n";
  ASSERT_OK_AND_ASSIGN(const ParsedMesh parsed, ParseMesh(bytes));
  FaceMatrix F(3, 3);
  F << 0, 1, 2, 2, 1, 3, 2, 3, 4;
  EXPECT_EQ(parsed.mesh.F, F);
  EXPECT_THAT(parsed.file_face, ElementsAre(0, 1, 2));
  EXPECT_EQ(parsed.num_file_faces, 3);
}

TEST(ParsePly, CountsFacesOfFewerThanThreeVertices) {
  ASSERT_OK_AND_ASSIGN(
      const ParsedMesh parsed,
      ParseMesh("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                "property float y\nproperty float z\nelement face 3\n"
                "property list uchar int vertex_indices\nend_header\n"
                "0 0 0\n1 0 0\n0 1 0\n2 0 1\n0\n3 0 1 2\n"));
  EXPECT_EQ(parsed.skipped_file_faces, 2);
  EXPECT_THAT(parsed.file_face, ElementsAre(2));
}

struct BadPly {
  std::string name;
  std::string bytes;
  absl::StatusCode code;
  std::string message;
};

class ParsePlyBad : public ::testing::TestWithParam<BadPly> {};

TEST_P(ParsePlyBad, IsRefusedWithAReason) {
  const BadPly& bad = GetParam();
  EXPECT_THAT(ParseMesh(bad.bytes, MeshFormat::kPly),
              StatusIs(bad.code, HasSubstr(bad.message)));
}

// The header's line `from` replaced by `to`.
std::string Changed(std::string text, const std::string& from,
                    const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

const std::string kText = Header("ascii") + kTextBody;
const std::string kBinary = Header("binary_little_endian", "float", "int int") +
                            BinaryBody<float, int32_t, int32_t>(false);

std::string WithListLength(int32_t length) {
  std::string bytes = kBinary;
  return bytes.replace(bytes.size() - 20, 4, Raw(length, false));
}

std::string WithLastIndex(int32_t index) {
  std::string bytes = kBinary;
  return bytes.replace(bytes.size() - 4, 4, Raw(index, false));
}

std::string WithFirstCoordinate(float value) {
  std::string bytes = kBinary;
  return bytes.replace(bytes.size() - 68, 4, Raw(value, false));
}

INSTANTIATE_TEST_SUITE_P(
    ParsePlyHeader, ParsePlyBad,
    ::testing::Values(
        BadPly{"Empty", "", kInvalid, "no bytes"},
        BadPly{"OnlyMagic", "ply\n", kInvalid, "before end_header"},
        BadPly{"OtherMagic", "plx\n", kInvalid, "not \"ply\""},
        BadPly{"CutBeforeEndHeader", "ply\nformat ascii 1.0\n", kInvalid,
               "PLY line 2: the bytes end before end_header"},
        BadPly{"PropertyBeforeElement",
               "ply\nformat ascii 1.0\nproperty float x\nend_header\n",
               kInvalid, "PLY line 3: property before any element"},
        BadPly{"NoFormat", "ply\nelement vertex 0\nend_header\n", kInvalid,
               "no format line"},
        BadPly{"UnknownFormat", "ply\nformat text 1.0\nend_header\n", kInvalid,
               "format \"text\" is unknown"},
        BadPly{"UnknownVersion", "ply\nformat ascii 2.0\nend_header\n",
               kInvalid, "version \"2.0\""},
        BadPly{"UnknownLine", "ply\nformat ascii 1.0\nfoo\nend_header\n",
               kInvalid, "line 3: \"foo\" is no header line"},
        BadPly{"UnknownType", Changed(kText, "float x", "real x"), kInvalid,
               "type \"real\" is unknown"},
        BadPly{"FloatListCount", Changed(kText, "uchar int", "float int"),
               kInvalid, "the count of a list is not of integer type"},
        BadPly{"PropertyWithoutName", Changed(kText, "float x", "float"),
               kInvalid, "property has no name"},
        BadPly{"NoVertexElement", "ply\nformat ascii 1.0\nend_header\n",
               kInvalid, "no element vertex"},
        BadPly{"TwoVertexElements",
               Changed(kText, "element face 1", "element vertex 1"), kInvalid,
               "2 elements vertex"},
        BadPly{"NoZ", Changed(kText, "float z", "float w"), kInvalid,
               "element vertex has 0 properties z"},
        BadPly{"ListedX", Changed(kText, "float x", "list uchar float x"),
               kInvalid, "element vertex has 0 properties x"},
        BadPly{"TwoX", Changed(kText, "float y", "float x"), kInvalid,
               "element vertex has 2 properties x"},
        BadPly{"NoIndices", Changed(kText, "vertex_indices", "corners"),
               kInvalid, "element face has 0 properties vertex_indices"},
        BadPly{"IndicesOfFloat", Changed(kText, "uchar int", "uchar float"),
               kInvalid, "element face has 0 properties vertex_indices"},
        BadPly{"CountNegative", Changed(kText, "vertex 4", "vertex -1"),
               kInvalid, "count -1 is negative"},
        BadPly{"CountBeyond64Bits",
               Changed(kText, "vertex 4", "vertex 99999999999999999999"),
               kInvalid, "element \"vertex\""},
        BadPly{"CountOf32Bits", Changed(kText, "vertex 4", "vertex 4294967295"),
               kExhausted, "4294967295 vertices, at most 20000000"},
        BadPly{"FacesOverLimit", Changed(kText, "face 1", "face 999999999"),
               kExhausted, "999999999 faces, at most 40000000"},
        BadPly{"VerticesWithoutProperties",
               "ply\nformat ascii 1.0\nelement vertex 10000000\nend_header\n",
               kInvalid, "10000000 items without properties"},
        BadPly{"OthersWithoutProperties",
               "ply\nformat binary_little_endian 1.0\nelement vertex 0\n"
               "element x 9000000000000000000\nend_header\n",
               kInvalid, "9000000000000000000 items without properties"},
        BadPly{"CountBeyondTheBytes",
               Changed(kText, "vertex 4", "vertex 10000000"), kInvalid,
               "10000000 items take at least 6 bytes each"},
        BadPly{"MoreBehindEndHeader",
               Changed(kText, "end_header", "end_header x"), kInvalid,
               "more than end_header"}),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    ParsePlyBody, ParsePlyBad,
    ::testing::Values(
        BadPly{"TruncatedText", kText.substr(0, kText.size() - 4), kInvalid,
               "PLY line 15: item 0: a list of 4 values, 6 bytes are left"},
        BadPly{"TruncatedTextWithBlanks",
               kText.substr(0, kText.size() - 4) + "      ", kInvalid,
               "PLY line 15: whole number: the bytes end here"},
        BadPly{"TruncatedBinary", kBinary.substr(0, kBinary.size() - 1),
               kInvalid, "a list of 4 values, 15 bytes are left"},
        BadPly{"TruncatedVertices", kBinary.substr(0, kBinary.size() - 40),
               kInvalid, "4 items take at least 12 bytes each, 28 are left"},
        BadPly{"LongerBinary", kBinary + "x", kInvalid,
               "1 bytes more than the header declares"},
        BadPly{"LongerText", kText + "0\n", kInvalid, "more lines than"},
        BadPly{"ListHuge", WithListLength(999999999), kInvalid,
               "a list of 999999999 values, 16 bytes are left"},
        BadPly{"ListNegative", WithListLength(-1), kInvalid,
               "a list of -1 values"},
        BadPly{"IndexBeyondTheVertices", WithLastIndex(4), kInvalid,
               "face 0: vertex 4 of 4"},
        BadPly{"IndexNegative", WithLastIndex(-1), kInvalid,
               "face 0: vertex -1 of 4"},
        BadPly{"NaN",
               WithFirstCoordinate(std::numeric_limits<float>::quiet_NaN()),
               kInvalid, "PLY byte 188: coordinate: nan"},
        BadPly{"Infinity",
               WithFirstCoordinate(std::numeric_limits<float>::infinity()),
               kInvalid, "coordinate: inf"},
        BadPly{"TextNaN", Changed(kText, "1 0 0", "1 nan 0"), kInvalid,
               "PLY line 12: coordinate: \"nan\" is not finite"},
        BadPly{"TextIndexNotWhole", Changed(kText, "4 0 1", "4 0 1.5"),
               kInvalid, "\"1.5\" is not a whole number"},
        BadPly{"TextOutsideItsType", Changed(kText, "4 0 1", "300 0 1"),
               kInvalid, "300 is outside the range 0 to 255"},
        BadPly{"NoFaces", Changed(kText, "4 0 1 2 3", "2 0 1"), kInvalid,
               "no faces"},
        BadPly{"StripIndexBelowRestart",
               Changed(Changed(kText, "element face", "element tristrips"),
                       "4 0 1", "4 0 -2"),
               kInvalid, "vertex -2 of 4"}),
    [](const auto& test) { return test.param.name; });

TEST(ParsePly, HoldsTheLimitOnTheValenceOfAFace) {
  MeshLimits limits;
  limits.max_polygon_vertices = 3;
  for (const std::string& bytes : {kText, kBinary}) {
    EXPECT_THAT(
        ParseMesh(bytes, MeshFormat::kPly, limits),
        StatusIs(kExhausted, HasSubstr("4 vertices in one face, at most 3")));
  }
}

}  // namespace
}  // namespace argmesh
