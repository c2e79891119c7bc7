#include "client/cli/label_table.h"

#include <gmock/gmock.h>

#include "tests/support/status_matchers.h"
#include "tests/unit/client/cli/scratch_folder.h"

namespace argmesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(ParseTabLines, SkipsEmptyLinesCommentsAndTheHeader) {
  ASSERT_OK_AND_ASSIGN(
      const auto lines,
      ParseTabLines("t", "path\tclass\r\n\n# x\na.off\tcup\r\nb.off\tant", 2,
                    2));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].line, 4);
  EXPECT_THAT(lines[0].columns, ElementsAre("a.off", "cup"));
  EXPECT_THAT(lines[1].columns, ElementsAre("b.off", "ant"));
}

TEST(ParseTabLines, NamesTheLineThatIsWrong) {
  EXPECT_THAT(ParseTabLines("labels.tsv", "a\tb\nc d\n", 2, 2),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       HasSubstr("labels.tsv line 2")));
  EXPECT_THAT(ParseTabLines("t", "a\tb\tc\td\n", 2, 3),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       HasSubstr("4 tab-separated")));
  EXPECT_THAT(ParseTabLines("t", "\tb\n", 2, 2),
              StatusIs(absl::StatusCode::kInvalidArgument, testing::_));
}

TEST(LabelTable, ResolvesPathsAgainstItsOwnFolder) {
  const ScratchFolder folder;
  folder.Add("meshes/cup/1.off", "x");
  folder.Add("meshes/other.off", "x");
  const std::string file =
      folder.Add("meshes/labels.tsv", "cup/1.off\tcup\ngone.off\tant\n");
  ASSERT_OK_AND_ASSIGN(const LabelTable table, LabelTable::Read(file));
  // Ingested from a folder above, below and the same: the label is found.
  for (const std::string& root :
       {std::string("."), std::string("meshes"), std::string("meshes/cup")}) {
    SCOPED_TRACE(root);
    ASSERT_OK_AND_ASSIGN(const auto files,
                         FindMeshFiles({(folder.path() / root).string()}));
    int found = 0;
    for (const MeshFile& mesh : files) {
      const auto label = table.ClassOf(mesh);
      if (label) {
        EXPECT_EQ(*label, "cup");
        EXPECT_EQ(mesh.path.filename(), "1.off");
        ++found;
      }
    }
    EXPECT_EQ(found, 1);
    EXPECT_THAT(table.Unused(files), ElementsAre("gone.off"));
  }
}

TEST(LabelTable, ResolvesPathsOfAFolderElsewhere) {
  const ScratchFolder folder;
  folder.Add("meshes/cup/1.off", "x");
  const std::string file = folder.Add("labels/l.tsv", "cup/1.off\tcup\n");
  ASSERT_OK_AND_ASSIGN(const LabelTable table, LabelTable::Read(file));
  ASSERT_OK_AND_ASSIGN(const auto files,
                       FindMeshFiles({(folder.path() / "meshes").string()}));
  EXPECT_EQ(table.ClassOf(files[0]), "cup");
}

TEST(LabelTable, RefusesTwoClassesOfOnePath) {
  const ScratchFolder folder;
  const std::string file = folder.Add("l.tsv", "a.off\tcup\n./a.off\tant\n");
  EXPECT_THAT(
      LabelTable::Read(file),
      StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("second class")));
}

}  // namespace
}  // namespace argmesh
