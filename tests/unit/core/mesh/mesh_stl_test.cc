// The STL parser through ParseMesh.
#include "core/mesh/mesh_stl.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "core/base/byte_writer.h"
#include "core/base/random.h"
#include "core/mesh/vertex_weld.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr auto kInvalid = absl::StatusCode::kInvalidArgument;
constexpr auto kExhausted = absl::StatusCode::kResourceExhausted;

std::string Facet(const std::string& a, const std::string& b,
                  const std::string& c) {
  return " facet normal 0 0 nan\n  outer loop\n   vertex " + a +
         "\n   vertex " + b + "\n   vertex " + c + "\n  endloop\n endfacet\n";
}

const std::string kFirst = Facet("0 0 0", "1 0 0", "1 1 0");
const std::string kSecond = Facet("0 0 0", "1 1 0", "0 1 0");
const std::string kSolid =
    "solid a name\n" + kFirst + kSecond + "endsolid a name\n";

// The same square; `header` may begin with "solid".
std::string Binary(const std::string& header = "", float first = 0,
                   uint32_t count = 2) {
  ByteWriter writer;
  std::string padded = header;
  padded.resize(80, ' ');
  writer.WriteBytes(padded);
  writer.WriteU32(count);
  const std::vector<std::vector<float>> facets = {
      {9, 9, 9, first, 0, 0, 1, 0, 0, 1, 1, 0},
      {9, 9, 9, -0.0F, 0, 0, 1, 1, 0, 0, 1, 0}};
  for (const std::vector<float>& facet : facets) {
    writer.WriteF32Array(facet);
    writer.WriteU16(0xFFFF);
  }
  return writer.TakeBytes();
}

void ExpectSquare(const std::string& bytes) {
  for (const MeshFormat told : {MeshFormat::kStl, MeshFormat::kUnknown}) {
    ASSERT_OK_AND_ASSIGN(const ParsedMesh parsed, ParseMesh(bytes, told));
    EXPECT_EQ(parsed.format, MeshFormat::kStl);
    FaceMatrix F(2, 3);
    F << 0, 1, 2, 0, 2, 3;
    EXPECT_EQ(parsed.mesh.F, F);
    ASSERT_EQ(parsed.mesh.num_vertices(), 4);
    EXPECT_EQ(parsed.mesh.vertex(3), Eigen::Vector3d(0, 1, 0));
    EXPECT_THAT(parsed.file_face, ElementsAre(0, 1));
  }
}

std::string WithLineEnd(const std::string& text, const std::string& line_end) {
  std::string changed;
  for (const char c : text) changed += c == '\n' ? line_end : std::string(1, c);
  return changed;
}

std::string UpperCase(std::string text) {
  for (char& c : text) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return text;
}

TEST(ParseStl, ReadsText) {
  ExpectSquare(kSolid);
  ExpectSquare(WithLineEnd(kSolid, "\r\n"));
  ExpectSquare(WithLineEnd(kSolid, "\r"));
  ExpectSquare(UpperCase(kSolid));
  ExpectSquare("solid\n" + WithLineEnd(kFirst + kSecond, " ") + "endsolid");
}

TEST(ParseStl, MakesOneMeshOfSeveralSolids) {
  ExpectSquare("solid a\n" + kFirst +
               "endsolid a\n\nsolid\nendsolid\nsolid b\n" + kSecond +
               "endsolid b\n");
}

TEST(ParseStl, TellsBinaryByItsSizeWhateverItsHeaderSays) {
  ExpectSquare(Binary());
  ExpectSquare(Binary("solid from a program that knows no better"));
  ExpectSquare(Binary("ply\n"));
}

TEST(ParseStl, CountsFacetsOfFewerThanThreeVertices) {
  ASSERT_OK_AND_ASSIGN(
      const ParsedMesh parsed,
      ParseMesh("solid\nfacet normal 0 0 1 outer loop vertex 8 8 8 vertex 9 9 "
                "9 endloop endfacet\n" +
                kFirst + "endsolid\n"));
  EXPECT_EQ(parsed.skipped_file_faces, 1);
  EXPECT_EQ(parsed.mesh.num_vertices(), 3);
  EXPECT_THAT(parsed.file_face, ElementsAre(1));
}

struct BadStl {
  std::string name;
  std::string bytes;
  absl::StatusCode code;
  std::string message;
};

class ParseStlBad : public ::testing::TestWithParam<BadStl> {};

TEST_P(ParseStlBad, IsRefusedWithAReason) {
  const BadStl& bad = GetParam();
  EXPECT_THAT(ParseMesh(bad.bytes, MeshFormat::kStl),
              StatusIs(bad.code, HasSubstr(bad.message)));
}

INSTANTIATE_TEST_SUITE_P(
    ParseStl, ParseStlBad,
    ::testing::Values(
        BadStl{"Empty", "", kInvalid, "no bytes"},
        BadStl{"RandomBytes", "\x9c\x12zzz", kInvalid,
               "5 bytes that do not begin with \"solid\""},
        BadStl{"ZeroBytes", std::string(300, '\0'), kInvalid,
               "STL byte 80: 0 facets take 84 bytes, the file has 300"},
        BadStl{"BinaryCountHuge", Binary("", 0, 0xFFFFFFFF), kInvalid,
               "4294967295 facets take 214748364834 bytes, the file has 184"},
        BadStl{"BinaryTruncated", Binary().substr(0, 150), kInvalid,
               "2 facets take 184 bytes, the file has 150"},
        BadStl{"BinaryLonger", Binary() + "x", kInvalid,
               "2 facets take 184 bytes, the file has 185"},
        BadStl{"BinaryNaN", Binary("", std::numeric_limits<float>::quiet_NaN()),
               kInvalid, "STL byte 96: facet 0: coordinate nan is not finite"},
        BadStl{"BinaryInfinity",
               Binary("", -std::numeric_limits<float>::infinity()), kInvalid,
               "coordinate -inf"},
        BadStl{"BinaryWithoutFacets", Binary("", 0, 0).substr(0, 84), kInvalid,
               "STL: no faces"},
        BadStl{"TextWithoutFacets", "solid a\nendsolid a\n", kInvalid,
               "STL: no faces"},
        BadStl{"TextCutInAFacet", kSolid.substr(0, 60), kInvalid, "STL line "},
        BadStl{"TextCutBetweenFacets", "solid\n" + kFirst, kInvalid,
               "the end of the bytes where facet or endsolid"},
        BadStl{"TextNaN", "solid\n" + Facet("0 nan 0", "1 0 0", "1 1 0"),
               kInvalid, "STL line 4: facet 0: \"nan\" is not finite"},
        BadStl{"TextNotANumber", "solid\n" + Facet("0 x 0", "1 0 0", "1 1 0"),
               kInvalid, "\"x\" is not a number"},
        BadStl{"TextFourVertices",
               "solid\n" + Facet("0 0 0", "1 0 0", "1 1 0\nvertex 0 1 0"),
               kInvalid, "facet 0: more than 3 vertices"},
        BadStl{"TextOtherWord", "solid\n facet normal 0 0 1\n inner loop\n",
               kInvalid, "line 3: facet 0: \"inner\" where outer is expected"},
        BadStl{"TextOtherAfterSolid", kSolid + "sold", kInvalid,
               "\"sold\" where solid is expected"},
        BadStl{"TextLineOverLimit",
               "solid\n" + std::string(2'000'000, 'x') + "\n", kExhausted,
               "line 2: the line has more than 1048576 bytes"}),
    [](const auto& test) { return test.param.name; });

TEST(ParseStl, HoldsTheLimitsOnFacetsAndVertices) {
  MeshLimits limits;
  limits.max_faces = 1;
  EXPECT_THAT(
      ParseMesh(Binary(), MeshFormat::kStl, limits),
      StatusIs(kExhausted, HasSubstr("STL byte 80: 2 facets, at most 1")));
  EXPECT_THAT(ParseMesh(kSolid, MeshFormat::kStl, limits),
              StatusIs(kExhausted, HasSubstr("2 facets, at most 1")));
  limits.max_faces = 2;
  limits.max_vertices = 3;
  EXPECT_THAT(ParseMesh(Binary(), MeshFormat::kStl, limits),
              StatusIs(kExhausted, HasSubstr("4 vertices, at most 3")));
}

TEST(WeldEqualPositions, NumbersPositionsInTheOrderOfTheirFirstUse) {
  const std::vector<double> coordinates = {
      5, 5, 5, 1, 1, 1, 5, 5, 5, 0, 0, -0.0, 1, 1, 1, 0, 0, 0, 1, 1, 1.0000001};
  const VertexWeld weld = WeldEqualPositions(coordinates);
  EXPECT_EQ(weld.num_vertices, 4);
  EXPECT_THAT(weld.vertex_of, ElementsAre(0, 1, 0, 2, 1, 2, 3));
}

TEST(WeldEqualPositions, JoinsExactlyTheEqualOnes) {
  constexpr uint64_t kSeed = 11;
  Random random(kSeed);
  std::vector<double> coordinates(3 * 500);
  for (double& c : coordinates) c = static_cast<double>(random.Below(5));
  const VertexWeld weld = WeldEqualPositions(coordinates);
  for (size_t i = 0; i < 500; ++i) {
    for (size_t j = 0; j < i; ++j) {
      const bool equal = coordinates[3 * i] == coordinates[3 * j] &&
                         coordinates[3 * i + 1] == coordinates[3 * j + 1] &&
                         coordinates[3 * i + 2] == coordinates[3 * j + 2];
      EXPECT_EQ(equal, weld.vertex_of[i] == weld.vertex_of[j])
          << "seed " << kSeed << " positions " << i << " and " << j;
    }
  }
}

}  // namespace
}  // namespace argmesh
