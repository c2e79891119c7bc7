#include "core/synthesis/sample_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "tests/support/status_matchers.h"
#include "tests/unit/core/synthesis/closed_surface.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

TEST(SampleClassNames, AreAscendingAndManyEnough) {
  const std::vector<std::string_view> names = SampleClassNames();
  EXPECT_GE(names.size(), 14U);
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
}

TEST(MakeSampleShape, GivesOneClosedManifoldOfTheStatedGenus) {
  for (const std::string_view name : SampleClassNames()) {
    for (uint64_t seed = 0; seed < 2; ++seed) {
      SCOPED_TRACE(std::string(name) + " seed " + std::to_string(seed));
      ASSERT_OK_AND_ASSIGN(const SampleShape shape,
                           MakeSampleShape(name, seed));
      EXPECT_THAT(CheckMesh(shape.mesh), IsOk());
      const SurfaceCounts counts = CountSurface(shape.mesh);
      EXPECT_EQ(counts.unpaired_halfedges, 0);
      EXPECT_EQ(counts.broken_fans, 0);
      EXPECT_EQ(counts.components, 1);
      EXPECT_EQ(counts.euler, 2 - 2 * shape.genus);
      EXPECT_GT(SignedVolume(shape.mesh), 0);
      EXPECT_GE(shape.mesh.num_vertices(), 3000);
      EXPECT_LE(shape.mesh.num_vertices(), 14000);
    }
  }
}

TEST(MakeSampleShape, HasTheGenusAPersonWouldCount) {
  const std::map<std::string, int> expected = {
      {"mug", 1},  {"teapot", 1}, {"glasses", 2}, {"key", 1},
      {"vase", 0}, {"human", 0},  {"octopus", 0}, {"table", 0}};
  for (const auto& [name, genus] : expected) {
    ASSERT_OK_AND_ASSIGN(const SampleShape shape, MakeSampleShape(name, 5));
    EXPECT_EQ(shape.genus, genus) << name;
  }
}

TEST(MakeSampleShape, RepeatsForEqualSeedsAndDiffersForOthers) {
  for (const char* name : {"octopus", "chair"}) {
    ASSERT_OK_AND_ASSIGN(const SampleShape a, MakeSampleShape(name, 9));
    ASSERT_OK_AND_ASSIGN(const SampleShape b, MakeSampleShape(name, 9));
    ASSERT_OK_AND_ASSIGN(const SampleShape c, MakeSampleShape(name, 10));
    EXPECT_EQ(a.mesh.V, b.mesh.V) << name;
    EXPECT_EQ(a.mesh.F, b.mesh.F) << name;
    EXPECT_EQ(a.part_of_face, b.part_of_face) << name;
    EXPECT_FALSE(a.mesh.V.rows() == c.mesh.V.rows() && a.mesh.V == c.mesh.V)
        << name;
  }
}

TEST(MakeSampleShape, LabelsEveryFaceAndShowsEveryPart) {
  for (const std::string_view name : SampleClassNames()) {
    ASSERT_OK_AND_ASSIGN(const SampleShape shape,
                         MakeSampleShape(name, 4, {.target_vertices = 2000}));
    ASSERT_EQ(shape.part_of_face.size(),
              static_cast<size_t>(shape.mesh.num_faces()));
    std::vector<int> faces(shape.part_names.size(), 0);
    for (const int32_t part : shape.part_of_face) {
      ASSERT_GE(part, 0) << name;
      ASSERT_LT(static_cast<size_t>(part), faces.size()) << name;
      ++faces[static_cast<size_t>(part)];
    }
    for (size_t part = 0; part < faces.size(); ++part) {
      EXPECT_GT(faces[part], 10) << name << " " << shape.part_names[part];
    }
  }
}

TEST(MakeSampleShape, HasMoreVerticesWhenAskedForMore) {
  ASSERT_OK_AND_ASSIGN(const SampleShape few,
                       MakeSampleShape("bird", 1, {.target_vertices = 3000}));
  ASSERT_OK_AND_ASSIGN(const SampleShape many,
                       MakeSampleShape("bird", 1, {.target_vertices = 12000}));
  EXPECT_GT(many.mesh.num_vertices(), 3 * few.mesh.num_vertices());
}

TEST(MakeSampleShape, RefusesUnknownClassesAndBadOptions) {
  EXPECT_THAT(MakeSampleShape("unicorn", 1),
              StatusIs(absl::StatusCode::kNotFound, HasSubstr("unicorn")));
  EXPECT_THAT(MakeSampleShape("mug", 1, {.target_vertices = 10}),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       HasSubstr("target_vertices 10")));
}

}  // namespace
}  // namespace argmesh
