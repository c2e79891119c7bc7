// The OFF parser through ParseMesh.
#include "core/mesh/mesh_off.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr auto kInvalid = absl::StatusCode::kInvalidArgument;
constexpr auto kExhausted = absl::StatusCode::kResourceExhausted;

// A tetrahedron, without its header.
constexpr char kBody[] =
    "0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
    "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

FaceMatrix TetrahedronFaces() {
  FaceMatrix F(4, 3);
  F << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
  return F;
}

struct GoodOff {
  std::string name;
  std::string bytes;
};

class ParseOffGood : public ::testing::TestWithParam<GoodOff> {};

TEST_P(ParseOffGood, GivesTheTetrahedron) {
  for (const MeshFormat told : {MeshFormat::kOff, MeshFormat::kUnknown}) {
    ASSERT_OK_AND_ASSIGN(const ParsedMesh parsed,
                         ParseMesh(GetParam().bytes, told));
    EXPECT_EQ(parsed.format, MeshFormat::kOff);
    EXPECT_EQ(parsed.mesh.F, TetrahedronFaces());
    ASSERT_EQ(parsed.mesh.num_vertices(), 4);
    EXPECT_EQ(parsed.mesh.vertex(3), Eigen::Vector3d(0, 0, 1));
    EXPECT_EQ(parsed.num_file_faces, 4);
    EXPECT_THAT(parsed.file_face, ElementsAre(0, 1, 2, 3));
    EXPECT_EQ(parsed.skipped_file_faces, 0);
  }
}

std::string WithLineEnd(std::string text, const std::string& line_end) {
  std::string changed;
  for (const char c : text) {
    if (c == '\n') {
      changed += line_end;
    } else {
      changed += c;
    }
  }
  return changed;
}

std::string WithExtras(const std::string& vertex_extras,
                       const std::string& face_extras) {
  std::string text;
  int line = 0;
  for (const char c : std::string(kBody)) {
    if (c == '\n') text += line++ < 4 ? vertex_extras : face_extras;
    text += c;
  }
  return text;
}

const std::string kOff = std::string("OFF\n4 4 6\n") + kBody;

INSTANTIATE_TEST_SUITE_P(
    ParseOff, ParseOffGood,
    ::testing::Values(
        GoodOff{"Plain", kOff},
        GoodOff{"CountsOnTheFirstLine", std::string("OFF 4 4 6\n") + kBody},
        GoodOff{"CountsGluedToTheWord", std::string("OFF4 4 6\n") + kBody},
        GoodOff{"WithoutTheWord", std::string("4 4 6\n") + kBody},
        GoodOff{"WithoutEdgeCount", std::string("OFF\n4 4\n") + kBody},
        GoodOff{"LowerCase", std::string("off\n4 4 6\n") + kBody},
        GoodOff{"CarriageReturnLineFeed", WithLineEnd(kOff, "\r\n")},
        GoodOff{"LoneCarriageReturn", WithLineEnd(kOff, "\r")},
        GoodOff{"BlankLines", WithLineEnd(kOff, "\n \t\n")},
        GoodOff{"NoLastLineEnd", kOff.substr(0, kOff.size() - 1)},
        GoodOff{"ByteOrderMark", "\xEF\xBB\xBF" + kOff},
        GoodOff{"Comments", "# one\n" + WithLineEnd(kOff, " # 9 9\n#x\n")},
        GoodOff{"Colors", std::string("COFF\n4 4 6\n") +
                              WithExtras(" 255 0 0 255", " 0.5 0.5 0.5")},
        GoodOff{"Normals",
                std::string("NOFF\n4 4 6\n") + WithExtras(" 0 0 nan", "")},
        GoodOff{"ColorsAndNormals", std::string("CNOFF\n4 4 6\n") +
                                        WithExtras(" 0 0 1 1 1 1 1", " 12")},
        GoodOff{"Texture", std::string("STOFF\n4 4 6\n") +
                               WithExtras(" 0.5 0.5", " 1 2 3 4")},
        GoodOff{"NormalsOnTheNextLine",
                std::string("NOFF\n4 4 6\n") + WithExtras("\n0 0 1", "")},
        GoodOff{"FaceColorsWithoutHeader",
                std::string("OFF\n4 4 6\n") + WithExtras("", " 255 0 0")}),
    [](const auto& test) { return test.param.name; });

TEST(ParseOff, SplitsPolygonsAndRemembersTheirFace) {
  ASSERT_OK_AND_ASSIGN(
      const ParsedMesh parsed,
      ParseMesh("OFF\n5 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n"
                "4 0 1 2 3\n3 0 1 4\n"));
  FaceMatrix F(3, 3);
  F << 0, 1, 2, 0, 2, 3, 0, 1, 4;
  EXPECT_EQ(parsed.mesh.F, F);
  EXPECT_THAT(parsed.file_face, ElementsAre(0, 0, 1));
  EXPECT_EQ(parsed.num_file_faces, 2);
}

TEST(ParseOff, CountsFacesOfFewerThanThreeVerticesAndGoesOn) {
  ASSERT_OK_AND_ASSIGN(const ParsedMesh parsed,
                       ParseMesh("OFF\n3 4 0\n0 0 0\n1 0 0\n0 1 0\n"
                                 "2 0 1\n3 0 1 2\n0\n1 2\n"));
  EXPECT_EQ(parsed.mesh.num_faces(), 1);
  EXPECT_THAT(parsed.file_face, ElementsAre(1));
  EXPECT_EQ(parsed.num_file_faces, 4);
  EXPECT_EQ(parsed.skipped_file_faces, 3);
}

TEST(ParseOff, KeepsVerticesThatNoFaceUses) {
  ASSERT_OK_AND_ASSIGN(
      const ParsedMesh parsed,
      ParseMesh("OFF\n4 1 0\n9 9 9\n0 0 0\n1 0 0\n0 1 0\n3 1 2 3\n"));
  EXPECT_EQ(parsed.mesh.num_vertices(), 4);
}

struct BadOff {
  std::string name;
  std::string bytes;
  absl::StatusCode code;
  std::string message;
};

class ParseOffBad : public ::testing::TestWithParam<BadOff> {};

TEST_P(ParseOffBad, IsRefusedWithAReason) {
  const BadOff& bad = GetParam();
  EXPECT_THAT(ParseMesh(bad.bytes, MeshFormat::kOff),
              StatusIs(bad.code, HasSubstr(bad.message)));
}

INSTANTIATE_TEST_SUITE_P(
    ParseOff, ParseOffBad,
    ::testing::Values(
        BadOff{"Empty", "", kInvalid, "no bytes"},
        BadOff{"OnlyBlanks", " \n\n", kInvalid, "OFF line 2: no header"},
        BadOff{"OtherWord", "PLY\n", kInvalid, "line 1: \"PLY\" where OFF"},
        BadOff{"NoCounts", "OFF\n", kInvalid,
               "number of vertices: the bytes end here"},
        BadOff{"OneCount", "OFF\n3\n", kInvalid, "number of faces"},
        BadOff{"FourCounts", "OFF 1 2 3 4\n", kInvalid, "line 1: more than"},
        BadOff{"CountNotWhole", "OFF\n3.5 1 0\n", kInvalid,
               "line 2: number of vertices: \"3.5\" is not a whole number"},
        BadOff{"CountNegative", "OFF\n-1 1 0\n", kInvalid, "-1 is negative"},
        BadOff{"CountBeyond64Bits", "OFF\n99999999999999999999999 1 0\n",
               kInvalid, "number of vertices"},
        BadOff{"CountOverLimit", "OFF\n999999999 1 0\n", kExhausted,
               "OFF line 2: 999999999 vertices, at most 20000000"},
        BadOff{"CountOf32Bits", "OFF\n4294967295 1 0\n", kExhausted,
               "at most 20000000"},
        BadOff{"FacesOverLimit", "OFF\n3 999999999 0\n", kExhausted,
               "999999999 faces, at most 40000000"},
        BadOff{"CountBeyondTheBytes", "OFF\n1000 1 0\n0 0 0\n", kInvalid,
               "1000 vertices and 1 faces take at least 6002 bytes, 7 are"},
        BadOff{"Binary", "OFF BINARY\n\x01\x02", kInvalid, "OFF BINARY"},
        BadOff{"FourDimensions", "4OFF\n1 1 0\n", kInvalid, "\"4OFF\""},
        BadOff{"ManyDimensions", "nOFF\n3\n", kInvalid, "\"nOFF\""},
        BadOff{"TruncatedInVertices", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 0\n    ",
               kInvalid, "vertex 2: the bytes end here"},
        BadOff{"TruncatedInFaces", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
               kInvalid, "line 6: face 1: the bytes end here"},
        BadOff{"TruncatedInAFace", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1",
               kInvalid, "line 6: face 0: the bytes end here"},
        BadOff{"NotANumber", "OFF\n3 1 0\n0 x 0\n1 0 0\n0 1 0\n3 0 1 2\n",
               kInvalid, "line 3: vertex 0: \"x\" is not a number"},
        BadOff{"DecimalComma", "OFF\n3 1 0\n0 0,5 0\n1 0 0\n0 1 0\n3 0 1 2\n",
               kInvalid, "\"0,5\" is not a number"},
        BadOff{"NaN", "OFF\n3 1 0\n0 nan 0\n1 0 0\n0 1 0\n3 0 1 2\n", kInvalid,
               "line 3: vertex 0: \"nan\" is not finite"},
        BadOff{"Infinity", "OFF\n3 1 0\n0 0 -inf\n1 0 0\n0 1 0\n3 0 1 2\n",
               kInvalid, "\"-inf\" is not finite"},
        BadOff{"BeyondDouble", "OFF\n3 1 0\n0 0 1e400\n1 0 0\n0 1 0\n3 0 1 2\n",
               kInvalid, "\"1e400\" is not finite or beyond"},
        BadOff{"BeyondFloat", "OFF\n3 1 0\n0 0 1e39\n1 0 0\n0 1 0\n3 0 1 2\n",
               kInvalid, "\"1e39\" is not finite or beyond"},
        BadOff{"IndexBeyondTheVertices",
               "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", kInvalid,
               "line 6: face 0: vertex 3 of 3"},
        BadOff{"IndexNegative", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n",
               kInvalid, "face 0: vertex -1 of 3"},
        BadOff{"ValenceNegative", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n",
               kInvalid, "face 0: -3 vertices"},
        BadOff{"ValenceOverLimit",
               "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n999999999 0 1 2\n", kExhausted,
               "999999999 vertices in one face, at most 10000"},
        BadOff{"ValenceBeyondTheBytes",
               "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n9000 0 1 2\n", kInvalid,
               "face 0: the bytes end here"},
        BadOff{"NoFaces", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", kInvalid,
               "no faces: 3 vertices"},
        BadOff{"OnlyLines", "OFF\n2 1 0\n0 0 0\n1 0 0\n2 0 1\n", kInvalid,
               "1 faces of fewer than 3"},
        BadOff{"MoreThanDeclared", kOff + "3 0 1 2\n", kInvalid,
               "line 11: more than the declared 4 vertices and 4 faces"},
        BadOff{"LineOverLimit", "OFF\n# " + std::string(1 << 20, 'x') + "\n",
               kExhausted, "line 2: the line has more than 1048576 bytes"},
        BadOff{"Utf16", std::string("\xFF\xFEO\0F\0F\0", 8), kInvalid,
               "UTF-16"},
        BadOff{"ZeroBytes", std::string(100, '\0'), kInvalid, "where OFF"}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace argmesh
