#include "server/rpc/resource_name.h"

#include <gtest/gtest.h>

#include <string>

#include "server/engine/error_reason.h"
#include "server/engine/utf8.h"

namespace argmesh {
namespace {

TEST(ResourceName, GivesNamesBack) {
  EXPECT_EQ(*ParseCollectionName("name", CollectionName("cups")), "cups");
  const auto shape = ParseShapeName("name", ShapeName("cups", "cup-21"));
  ASSERT_TRUE(shape.ok());
  EXPECT_EQ(shape->collection, "cups");
  EXPECT_EQ(shape->id, "cup-21");
}

TEST(ResourceName, RefusesEverythingElseAndNamesTheField) {
  EXPECT_EQ(ReasonOf(ParseCollectionName("parent", "").status()),
            ErrorReason::kFieldRequired);
  for (const char* name :
       {"cups", "/collections/cups", "collections/", "collections/Cups",
        "collections/cups/", "collections/cups/shapes/a", "collections//a",
        "Collections/cups", "collections/-", "collections/a-"}) {
    const absl::Status status = ParseCollectionName("parent", name).status();
    EXPECT_EQ(ReasonOf(status), ErrorReason::kNameInvalid) << name;
    EXPECT_EQ(MetadataOf(status).at("field"), "parent");
  }
  for (const char* name :
       {"collections/cups", "collections/cups/shapes", "shapes/a",
        "collections/cups/shapes/", "collections/cups/shapes/a/b",
        "collections/cups/meshes/a", "collections//shapes/a",
        "collections/cups//shapes/a"}) {
    EXPECT_EQ(ReasonOf(ParseShapeName("name", name).status()),
              ErrorReason::kNameInvalid)
        << name;
  }
}

TEST(ResourceName, ShowsOnlyTheBeginningOfAHugeName) {
  const absl::Status status =
      ParseShapeName("name", std::string(1 << 20, 'x')).status();
  EXPECT_LT(status.message().size(), 500u);
}

// protobuf's clients refuse to read a status with half a character in it.
TEST(ResourceName, CutsAHugeNameBetweenCharacters) {
  std::string name;
  for (int i = 0; i < 1000; ++i) name += "\xE2\x82\xAC";
  for (size_t before = 0; before < 3; ++before) {
    const absl::Status status =
        ParseShapeName("name", std::string(before, 'x') + name).status();
    EXPECT_TRUE(IsUtf8(std::string(status.message()))) << before;
    const absl::Status id =
        CheckResourceId("id", std::string(before, 'x') + name);
    EXPECT_TRUE(IsUtf8(std::string(id.message()))) << before;
  }
}

}  // namespace
}  // namespace argmesh
