#include "core/mesh/mesh_format.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/base/random.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

TEST(MeshFormatFromPath, GoesByTheExtensionInAnyCase) {
  EXPECT_EQ(MeshFormatFromPath("a/b.off"), MeshFormat::kOff);
  EXPECT_EQ(MeshFormatFromPath("b.tar.OBJ"), MeshFormat::kObj);
  EXPECT_EQ(MeshFormatFromPath("b.Ply"), MeshFormat::kPly);
  EXPECT_EQ(MeshFormatFromPath(".stl"), MeshFormat::kStl);
  for (const std::string_view path : {"", "off", "a.off/b", "a.of", "a.off "}) {
    EXPECT_EQ(MeshFormatFromPath(path), MeshFormat::kUnknown) << path;
  }
}

TEST(MeshFormatName, IsTheExtension) {
  for (const MeshFormat format : {MeshFormat::kOff, MeshFormat::kObj,
                                  MeshFormat::kPly, MeshFormat::kStl}) {
    EXPECT_EQ(MeshFormatFromPath("x." + std::string(MeshFormatName(format))),
              format);
  }
  EXPECT_EQ(MeshFormatName(MeshFormat::kUnknown), "unknown");
}

TEST(ParseMesh, RefusesBytesOfNoFormat) {
  EXPECT_THAT(ParseMesh("hello world\n"),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       HasSubstr("\"hello world\\n\" begins no OFF")));
  EXPECT_THAT(ParseMesh(std::string(10, '\0')),
              StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("\\x00")));
}

TEST(ParseMesh, HoldsTheLimitOnBytes) {
  MeshLimits limits;
  limits.max_bytes = 9;
  EXPECT_THAT(ParseMesh("OFF\n3 1 0\n", MeshFormat::kOff, limits),
              StatusIs(absl::StatusCode::kResourceExhausted,
                       HasSubstr("10 bytes, at most 9")));
}

TEST(ParseMesh, EndsInAResultOrAReasonForAnyDamage) {
  const std::string whole =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
      "property float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
  for (uint64_t seed = 1; seed <= 3000; ++seed) {
    Random random(seed);
    std::string bytes = whole;
    for (int i = 0; i < 3; ++i) {
      bytes[random.Below(bytes.size())] = static_cast<char>(random.Below(256));
    }
    bytes.resize(bytes.size() - random.Below(20));
    const auto parsed = ParseMesh(bytes);
    if (parsed.ok()) {
      EXPECT_THAT(CheckMesh(parsed->mesh), IsOk()) << "seed " << seed;
      EXPECT_GT(parsed->mesh.num_faces(), 0) << "seed " << seed;
    } else {
      EXPECT_FALSE(parsed.status().message().empty()) << "seed " << seed;
    }
  }
}

// A star with every second corner reflex, `copies` times.
std::string Stars(int valence, int copies) {
  std::string bytes;
  std::string face = "f";
  for (int i = 0; i < valence; ++i) {
    const double angle = 2 * std::numbers::pi * i / valence;
    const double radius = 1 + i % 2;
    bytes += "v " + std::to_string(radius * std::cos(angle)) + " " +
             std::to_string(radius * std::sin(angle)) + " 0\n";
    face += " " + std::to_string(i + 1);
  }
  for (int copy = 0; copy < copies; ++copy) bytes += face + "\n";
  return bytes;
}

TEST(ParseMesh, BoundsTheWorkOnHugePolygons) {
  EXPECT_THAT(ParseMesh(Stars(10'000, 1)), IsOk());
  EXPECT_THAT(ParseMesh(Stars(3'000, 100)),
              StatusIs(absl::StatusCode::kResourceExhausted,
                       HasSubstr("polygon of 3000 vertices: too many tests")));
}

}  // namespace
}  // namespace argmesh
