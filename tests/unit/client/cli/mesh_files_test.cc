#include "client/cli/mesh_files.h"

#include <gmock/gmock.h>

#include <set>

#include "core/base/identifier.h"
#include "tests/support/status_matchers.h"
#include "tests/unit/client/cli/scratch_folder.h"

namespace argmesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> Relatives(const std::vector<MeshFile>& files) {
  std::vector<std::string> relatives;
  for (const MeshFile& file : files) relatives.push_back(file.relative);
  return relatives;
}

TEST(FindMeshFiles, TakesMeshesOfAnyCaseBelowAFolderInOrder) {
  const ScratchFolder folder;
  for (const char* name : {"b/2.STL", "b/1.off", "a.Obj", "c.ply", "notes.txt",
                           ".hidden.off", ".git/x.off"}) {
    folder.Add(name, "x");
  }
  ASSERT_OK_AND_ASSIGN(const auto files,
                       FindMeshFiles({folder.path().string()}));
  EXPECT_THAT(Relatives(files),
              ElementsAre("a.Obj", "b/1.off", "b/2.STL", "c.ply"));
  EXPECT_EQ(files[0].format, v1::MESH_FORMAT_OBJ);
  EXPECT_EQ(files[2].format, v1::MESH_FORMAT_STL);
  EXPECT_EQ(files[1].shape_id, IdentifierFromPath("b/1.off"));
}

TEST(FindMeshFiles, NamesASingleFileByItsName) {
  const ScratchFolder folder;
  const std::string file = folder.Add("deep/down/part.off", "x");
  ASSERT_OK_AND_ASSIGN(const auto files, FindMeshFiles({file}));
  EXPECT_THAT(Relatives(files), ElementsAre("part.off"));
}

TEST(FindMeshFiles, GivesDifferentFilesDifferentIds) {
  const ScratchFolder folder;
  for (const char* name :
       {"Cup/21.off", "cup-21.off", "cup/21.OFF", "cup_21.off", "CUP-21.off"}) {
    folder.Add(name, "x");
  }
  ASSERT_OK_AND_ASSIGN(const auto files,
                       FindMeshFiles({folder.path().string()}));
  std::set<std::string> ids;
  for (const MeshFile& file : files) {
    EXPECT_TRUE(IsIdentifier(file.shape_id)) << file.shape_id;
    ids.insert(file.shape_id);
  }
  EXPECT_EQ(ids.size(), 5U);
}

TEST(FindMeshFiles, TellsEqualNamesOfDifferentFoldersApart) {
  const ScratchFolder folder;
  const std::string a = folder.Add("a/x.off", "1");
  const std::string b = folder.Add("b/x.off", "2");
  ASSERT_OK_AND_ASSIGN(const auto files, FindMeshFiles({a, b}));
  EXPECT_THAT(Relatives(files), ElementsAre("a/x.off", "b/x.off"));
  EXPECT_NE(files[0].shape_id, files[1].shape_id);
}

TEST(FindMeshFiles, CountsAFileGivenTwiceOnce) {
  const ScratchFolder folder;
  const std::string a = folder.Add("a.off", "1");
  ASSERT_OK_AND_ASSIGN(const auto files,
                       FindMeshFiles({folder.path().string(), a}));
  EXPECT_THAT(Relatives(files), ElementsAre("a.off"));
}

TEST(FindMeshFiles, RefusesWhatIsMissingOrNoMesh) {
  const ScratchFolder folder;
  const std::string text = folder.Add("notes.txt", "x");
  EXPECT_THAT(FindMeshFiles({text}),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       HasSubstr("not a mesh file")));
  EXPECT_THAT(
      FindMeshFiles({folder.path().string()}),
      StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("no mesh file")));
  EXPECT_THAT(
      FindMeshFiles({"/no/such/folder"}),
      StatusIs(absl::StatusCode::kNotFound, HasSubstr("/no/such/folder")));
}

TEST(ReadFile, RefusesAFileOverTheLimitBeforeReadingIt) {
  const ScratchFolder folder;
  const std::string file = folder.Add("a.off", "12345");
  EXPECT_THAT(ReadFile(file, 4),
              StatusIs(absl::StatusCode::kResourceExhausted,
                       HasSubstr("5 bytes, the limit is 4")));
  ASSERT_OK_AND_ASSIGN(const std::string bytes, ReadFile(file, 5));
  EXPECT_EQ(bytes, "12345");
}

}  // namespace
}  // namespace argmesh
