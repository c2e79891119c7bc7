#include "core/mesh/mesh_write.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// Triangles whose vertices are numbered by first use, as a reader of STL
// numbers them, with coordinates of very different sizes.
TriangleMesh RandomMesh(uint64_t seed, bool of_floats) {
  Random random(seed);
  const int faces = 1 + static_cast<int>(random.Below(50));
  TriangleMesh mesh;
  mesh.F.resize(faces, 3);
  int32_t used = 0;
  for (int f = 0; f < faces; ++f) {
    for (int corner = 0; corner < 3; ++corner) {
      const auto v =
          static_cast<int32_t>(random.Below(static_cast<uint64_t>(used) + 2));
      mesh.F(f, corner) = std::min(v, used);
      used = std::max(used, mesh.F(f, corner) + 1);
    }
  }
  mesh.V.resize(used, 3);
  for (int v = 0; v < used; ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      const double value =
          random.Normal() * std::pow(10.0, random.Uniform(-30, 30));
      mesh.V(v, axis) =
          of_floats ? static_cast<double>(static_cast<float>(value)) : value;
    }
  }
  return mesh;
}

TEST(SerializeMesh, IsReadBackAsTheSameMesh) {
  for (uint64_t seed = 1; seed <= 100; ++seed) {
    for (const MeshFormat format : {MeshFormat::kOff, MeshFormat::kObj,
                                    MeshFormat::kPly, MeshFormat::kStl}) {
      SCOPED_TRACE(std::string(MeshFormatName(format)) + " seed " +
                   std::to_string(seed));
      const TriangleMesh mesh = RandomMesh(seed, format == MeshFormat::kStl);
      ASSERT_OK_AND_ASSIGN(const std::string bytes,
                           SerializeMesh(mesh, format));
      ASSERT_OK_AND_ASSIGN(const ParsedMesh parsed, ParseMesh(bytes));
      EXPECT_EQ(parsed.format, format);
      EXPECT_EQ(parsed.mesh.V, mesh.V);
      EXPECT_EQ(parsed.mesh.F, mesh.F);
      EXPECT_EQ(parsed.skipped_file_faces, 0);
      EXPECT_EQ(parsed.ignored_statements, 0);
    }
  }
}

TEST(SerializeMesh, WritesTheShortestTextThatReadsBack) {
  TriangleMesh mesh;
  mesh.V.resize(3, 3);
  mesh.V << 0.1, -2, 1e30, 1.0 / 3, 0, 0, 5e-324, 0, 1;
  mesh.F.resize(1, 3);
  mesh.F << 0, 1, 2;
  ASSERT_OK_AND_ASSIGN(const std::string off,
                       SerializeMesh(mesh, MeshFormat::kOff));
  EXPECT_EQ(off,
            "OFF\n3 1 0\n0.1 -2 1e+30\n0.3333333333333333 0 0\n5e-324 0 1\n"
            "3 0 1 2\n");
  ASSERT_OK_AND_ASSIGN(const std::string obj,
                       SerializeMesh(mesh, MeshFormat::kObj));
  EXPECT_THAT(obj, StartsWith("v 0.1 -2 1e+30\n"));
  EXPECT_THAT(obj, HasSubstr("f 1 2 3\n"));
}

TEST(SerializeMesh, GivesStlItsUnitNormal) {
  TriangleMesh mesh;
  mesh.V.resize(3, 3);
  mesh.V << 0, 0, 0, 2, 0, 0, 0, 2, 0;
  mesh.F.resize(1, 3);
  mesh.F << 0, 1, 2;
  ASSERT_OK_AND_ASSIGN(const std::string stl,
                       SerializeMesh(mesh, MeshFormat::kStl));
  ASSERT_EQ(stl.size(), 134U);
  EXPECT_EQ(stl.substr(84, 12),
            std::string("\0\0\0\0\0\0\0\0\0\0\x80\x3F", 12));
}

TEST(SerializeMesh, RefusesWhatCouldNotBeReadBack) {
  const TriangleMesh good = RandomMesh(1, true);
  EXPECT_THAT(
      SerializeMesh(good, MeshFormat::kUnknown),
      StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("no format")));
  TriangleMesh bad = good;
  bad.F(0, 0) = good.num_vertices();
  EXPECT_THAT(SerializeMesh(bad, MeshFormat::kStl),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       HasSubstr("face 0: vertex")));
  for (const double value : {std::nan(""), 1e39}) {
    bad = good;
    bad.V(0, 1) = value;
    EXPECT_THAT(
        SerializeMesh(bad, MeshFormat::kOff),
        StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("vertex 0")));
  }
}

TEST(SerializeColoredPly, CarriesTheColorsBesideTheSameMesh) {
  const TriangleMesh mesh = RandomMesh(3, false);
  std::vector<RgbColor> colors(static_cast<size_t>(mesh.num_faces()),
                               {1, 2, 3});
  colors.back() = {250, 251, 252};
  const std::string bytes = SerializeColoredPly(mesh, colors);
  EXPECT_THAT(bytes, HasSubstr("property uchar red\n"));
  EXPECT_EQ(bytes.substr(bytes.size() - 3), "\xFA\xFB\xFC");
  ASSERT_OK_AND_ASSIGN(const ParsedMesh parsed, ParseMesh(bytes));
  EXPECT_EQ(parsed.mesh.V, mesh.V);
  EXPECT_EQ(parsed.mesh.F, mesh.F);
}

}  // namespace
}  // namespace argmesh
