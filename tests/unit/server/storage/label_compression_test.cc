#include "server/storage/label_compression.h"

#include <limits>
#include <string>

#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

TEST(CompressLabels, GivesBackEveryByte) {
  for (const std::string& labels :
       {std::string(), std::string("a"), std::string(1'000'000, 'x')}) {
    ASSERT_OK_AND_ASSIGN(const std::string compressed, CompressLabels(labels));
    ASSERT_OK_AND_ASSIGN(
        const std::string back,
        DecompressLabels(compressed, static_cast<int64_t>(labels.size())));
    EXPECT_EQ(back, labels);
  }
}

TEST(CompressLabels, MakesLabelsOfOneComponentSmall) {
  ASSERT_OK_AND_ASSIGN(const std::string compressed,
                       CompressLabels(std::string(1'000'000, 'x')));
  EXPECT_LT(compressed.size(), 1'000U);
}

TEST(DecompressLabels, RefusesSizesThatLieBeforeAllocating) {
  ASSERT_OK_AND_ASSIGN(const std::string compressed, CompressLabels("labels"));
  for (const int64_t size :
       {int64_t{5}, int64_t{7}, int64_t{-1}, kMaxLabelBytes + 1,
        std::numeric_limits<int64_t>::max()}) {
    EXPECT_EQ(DecompressLabels(compressed, size).status().code(),
              absl::StatusCode::kDataLoss)
        << size;
  }
}

TEST(DecompressLabels, RefusesDamagedBytes) {
  ASSERT_OK_AND_ASSIGN(const std::string good,
                       CompressLabels("labels of many faces"));
  for (size_t cut = 0; cut < good.size(); ++cut) {
    EXPECT_FALSE(DecompressLabels(good.substr(0, cut), 20).ok()) << cut;
  }
  EXPECT_FALSE(DecompressLabels("not zstd at all", 20).ok());
}

}  // namespace
}  // namespace argmesh
