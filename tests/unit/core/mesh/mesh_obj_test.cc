// The OBJ parser through ParseMesh.
#include "core/mesh/mesh_obj.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <string>

#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr auto kInvalid = absl::StatusCode::kInvalidArgument;
constexpr auto kExhausted = absl::StatusCode::kResourceExhausted;

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

FaceMatrix SquareFaces() {
  FaceMatrix F(2, 3);
  F << 0, 1, 2, 0, 2, 3;
  return F;
}

struct GoodObj {
  std::string name;
  std::string bytes;
};

class ParseObjGood : public ::testing::TestWithParam<GoodObj> {};

TEST_P(ParseObjGood, GivesTheSquare) {
  for (const MeshFormat told : {MeshFormat::kObj, MeshFormat::kUnknown}) {
    ASSERT_OK_AND_ASSIGN(const ParsedMesh parsed,
                         ParseMesh(GetParam().bytes, told));
    EXPECT_EQ(parsed.format, MeshFormat::kObj);
    EXPECT_EQ(parsed.mesh.F, SquareFaces());
    ASSERT_EQ(parsed.mesh.num_vertices(), 4);
    EXPECT_EQ(parsed.mesh.vertex(2), Eigen::Vector3d(1, 1, 0));
    EXPECT_EQ(parsed.ignored_statements, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(
    ParseObj, ParseObjGood,
    ::testing::Values(
        GoodObj{"Polygon", kSquare + "f 1 2 3 4\n"},
        GoodObj{"Triangles", kSquare + "f 1 2 3\nf 1 3 4\n"},
        GoodObj{"WithTexture", kSquare + "vt 0 0\nf 1/1 2/1 3/1 4/1\n"},
        GoodObj{"WithNormals", kSquare + "vn 0 0 1\nf 1//1 2//1 3//1 4//1\n"},
        GoodObj{"WithBoth", kSquare + "f 1/1/1 2/1/1 3/1/1 4/1/-1\n"},
        GoodObj{"EmptyTail", kSquare + "f 1/ 2// 3/1/ 4\n"},
        GoodObj{"NegativeIndices", kSquare + "f -4 -3 -2 -1\n"},
        GoodObj{"FacesFirst", "f 1 2 3 4\n" + kSquare},
        GoodObj{"Continued", kSquare + "f 1 2 \\\n3 \\\r\n 4\n"},
        GoodObj{"Commented", "# v 5 5 5\n" + kSquare + "f 1 2 3 4 # 1 2\n"},
        GoodObj{"CarriageReturns",
                "v 0 0 0\rv 1 0 0\rv 1 1 0\rv 0 1 0\rf 1 2 3 4\r"},
        GoodObj{"NoLastLineEnd", kSquare + "f 1 2 3 4"},
        GoodObj{"ColorsAndWeights",
                "v 0 0 0 1\nv 1 0 0 1 0 0\nv +1 1.0 0e0 .5 .5 .5 1\n"
                "v 0 1 0\nf 1 2 3 4\n"},
        GoodObj{"PassedOver",
                "mtllib /dev/zero ../../etc/passwd\no a\ng b c\ns off\n"
                "usemtl m\nvp 1 2\n" +
                    kSquare + "f 1 2 3 4\n"}),
    [](const auto& test) { return test.param.name; });

TEST(ParseObj, CountsNegativeIndicesFromTheVerticesSoFar) {
  ASSERT_OK_AND_ASSIGN(
      const ParsedMesh parsed,
      ParseMesh("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 1\nf -4 -3 -1\n",
                MeshFormat::kObj));
  FaceMatrix F(2, 3);
  F << 0, 1, 2, 0, 1, 3;
  EXPECT_EQ(parsed.mesh.F, F);
}

TEST(ParseObj, CountsWhatItIgnoresAndSkips) {
  ASSERT_OK_AND_ASSIGN(
      const ParsedMesh parsed,
      ParseMesh(kSquare + "l 1 2\np 1\nf 1 2\nfoo\nf\ncurv 0 1 2\n"
                          "f 1 2 3\n",
                MeshFormat::kObj));
  EXPECT_EQ(parsed.ignored_statements, 4);
  EXPECT_EQ(parsed.skipped_file_faces, 2);
  EXPECT_EQ(parsed.num_file_faces, 3);
  EXPECT_THAT(parsed.file_face, ElementsAre(2));
}

TEST(ParseObj, CutsAConcavePolygonWithoutCoveringItsNotch) {
  ASSERT_OK_AND_ASSIGN(
      const ParsedMesh parsed,
      ParseMesh("v 0 0 0\nv 2 -1 0\nv 1 0 0\nv 2 1 0\nf 2 3 4 1\n",
                MeshFormat::kObj));
  double area = 0;
  for (int f = 0; f < parsed.mesh.num_faces(); ++f) {
    const Eigen::Vector3d a = parsed.mesh.vertex(parsed.mesh.F(f, 0));
    const Eigen::Vector3d b = parsed.mesh.vertex(parsed.mesh.F(f, 1));
    const Eigen::Vector3d c = parsed.mesh.vertex(parsed.mesh.F(f, 2));
    area += (b - a).cross(c - a).norm() / 2;
  }
  EXPECT_DOUBLE_EQ(area, 1.0);
}

struct BadObj {
  std::string name;
  std::string bytes;
  absl::StatusCode code;
  std::string message;
};

class ParseObjBad : public ::testing::TestWithParam<BadObj> {};

TEST_P(ParseObjBad, IsRefusedWithAReason) {
  const BadObj& bad = GetParam();
  EXPECT_THAT(ParseMesh(bad.bytes, MeshFormat::kObj),
              StatusIs(bad.code, HasSubstr(bad.message)));
}

std::string ManyCorners(int count) {
  std::string text = kSquare + "f";
  for (int i = 0; i < count; ++i) text += " 1";
  return text + "\n";
}

INSTANTIATE_TEST_SUITE_P(
    ParseObj, ParseObjBad,
    ::testing::Values(
        BadObj{"Empty", "", kInvalid, "no bytes"},
        BadObj{"RandomBytes", "\x8f\x01\x93 zz\n\xff\xee", kInvalid,
               "no faces: 0 vertices"},
        BadObj{"NoFaces", kSquare, kInvalid, "no faces: 4 vertices"},
        BadObj{"TwoCoordinates", "v 0 0\nv 1 0 0\n", kInvalid,
               "OBJ line 1: vertex 1: a number is missing"},
        BadObj{"NaN", "v 0 0 0\nv nan 0 0\n", kInvalid,
               "line 2: vertex 2: \"nan\" is not finite"},
        BadObj{"BeyondDouble", "v 0 1e400 0\n", kInvalid, "\"1e400\""},
        BadObj{"IndexZero", kSquare + "f 0 1 2\n", kInvalid,
               "line 5: face 1: vertex 0 of 4"},
        BadObj{"IndexBeyondTheVertices", kSquare + "f 1 2 3\nf 1 2 5\n",
               kInvalid, "OBJ line 6: face 2: vertex 5 of 4"},
        BadObj{"IndexBeforeTheFirst", kSquare + "f -5 1 2\n", kInvalid,
               "face 1: vertex -5 of 4"},
        BadObj{"IndexBeyond32Bits", kSquare + "f 1 2 4294967297\n", kInvalid,
               "vertex 4294967297 of 4"},
        BadObj{"IndexBeyond64Bits", kSquare + "f 1 2 99999999999999999999\n",
               kInvalid, "is no vertex"},
        BadObj{"CornerNotANumber", kSquare + "f 1 2 x\n", kInvalid,
               "\"x\" is no vertex"},
        BadObj{"CornerOnlyTexture", kSquare + "f 1 2 /3\n", kInvalid,
               "\"/3\" is no vertex"},
        BadObj{"CornerThreeSlashes", kSquare + "f 1 2 3/1/1/1\n", kInvalid,
               "\"3/1/1/1\" is no vertex"},
        BadObj{"CornerBadTexture", kSquare + "f 1 2 3/x\n", kInvalid,
               "\"3/x\" is no vertex"},
        BadObj{"MillionSlashes",
               kSquare + "f 1" + std::string(1'000'000, '/') + " 2 3\n",
               kInvalid, "line 5: face 1: \"1///"},
        BadObj{"LineOverLimit",
               kSquare + "f 1" + std::string(2'000'000, '/') + " 2 3\n",
               kExhausted, "line 5: the line has more than 1048576 bytes"},
        BadObj{"ValenceOverLimit", ManyCorners(10'001), kExhausted,
               "line 5: 10001 vertices in one face, at most 10000"}),
    [](const auto& test) { return test.param.name; });

TEST(ParseObj, HoldsTheLimitsOnVerticesAndTriangles) {
  MeshLimits limits;
  limits.max_vertices = 3;
  EXPECT_THAT(ParseMesh(kSquare + "f 1 2 3\n", MeshFormat::kObj, limits),
              StatusIs(kExhausted, HasSubstr("line 4: 4 vertices, at most 3")));
  limits.max_vertices = 4;
  limits.max_faces = 1;
  EXPECT_THAT(ParseMesh(kSquare + "f 1 2 3\n", MeshFormat::kObj, limits),
              IsOk());
  EXPECT_THAT(ParseMesh(kSquare + "f 1 2 3 4\n", MeshFormat::kObj, limits),
              StatusIs(kExhausted, HasSubstr("2 triangles, at most 1")));
}

}  // namespace
}  // namespace argmesh
