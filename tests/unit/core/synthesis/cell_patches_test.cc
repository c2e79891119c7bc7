#include "core/synthesis/cell_patches.h"

#include <gtest/gtest.h>

#include <set>

namespace argmesh {
namespace {

bool Inside(unsigned config, int corner) {
  return (config >> corner & 1U) != 0;
}

TEST(PatchesOfCell, GivesAPatchToExactlyTheCrossedEdges) {
  for (unsigned config = 0; config < 256; ++config) {
    const CellPatches& patches = PatchesOfCell(static_cast<uint8_t>(config));
    for (int edge = 0; edge < 12; ++edge) {
      const int low = EdgeCorner(edge);
      const int high = low | 1 << (edge / 4);
      ASSERT_NE(low, high);
      const int patch = patches.patch_of_edge[static_cast<size_t>(edge)];
      EXPECT_EQ(patch >= 0, Inside(config, low) != Inside(config, high))
          << "config " << config << " edge " << edge;
      EXPECT_LT(patch, patches.num_patches);
    }
  }
}

TEST(PatchesOfCell, KeepsEveryPatchAtLeastThreeEdgesLong) {
  for (unsigned config = 1; config < 255; ++config) {
    const CellPatches& patches = PatchesOfCell(static_cast<uint8_t>(config));
    EXPECT_GE(patches.num_patches, 1);
    EXPECT_LE(patches.num_patches, 4);
    for (int patch = 0; patch < patches.num_patches; ++patch) {
      int edges = 0;
      for (const int32_t p : patches.patch_of_edge) edges += p == patch ? 1 : 0;
      EXPECT_GE(edges, 3) << "config " << config;
    }
  }
}

TEST(PatchesOfCell, SeparatesInsideCornersThatMeetOnlyDiagonally) {
  EXPECT_EQ(PatchesOfCell(0).num_patches, 0);
  EXPECT_EQ(PatchesOfCell(255).num_patches, 0);
  EXPECT_EQ(PatchesOfCell(0b00000001).num_patches, 1);
  EXPECT_EQ(PatchesOfCell(0b00001001).num_patches, 2);  // on one face
  EXPECT_EQ(PatchesOfCell(0b10000001).num_patches, 2);  // through the cell
  EXPECT_EQ(PatchesOfCell(0b01101001).num_patches, 4);
  EXPECT_EQ(PatchesOfCell(0b00001111).num_patches, 1);
}

}  // namespace
}  // namespace argmesh
