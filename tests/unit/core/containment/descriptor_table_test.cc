#include "core/containment/descriptor_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/random.h"

namespace argmesh {
namespace {

std::vector<WindowDescriptor> RandomRows(size_t count, uint64_t seed) {
  Random random(seed);
  std::vector<WindowDescriptor> rows(count);
  for (WindowDescriptor& row : rows) {
    for (int8_t& x : row) {
      x = static_cast<int8_t>(static_cast<int>(random.Below(255)) - 127);
    }
  }
  return rows;
}

float Squared(const WindowDescriptor& a, const WindowDescriptor& b) {
  int sum = 0;
  for (size_t d = 0; d < kWindowDims; ++d) sum += (a[d] - b[d]) * (a[d] - b[d]);
  return static_cast<float>(sum);
}

TEST(DescriptorTable, FindsTheNearestRowsExactly) {
  for (const size_t count : {1u, 2u, 15u, 16u, 17u, 333u}) {
    std::vector<WindowDescriptor> rows = RandomRows(count, count);
    rows.push_back(rows.front());  // a tie
    const DescriptorTable table(rows);
    for (const WindowDescriptor& query : RandomRows(20, 99)) {
      std::vector<std::pair<float, int32_t>> expected;
      for (size_t i = 0; i < rows.size(); ++i) {
        expected.emplace_back(Squared(query, rows[i]), static_cast<int32_t>(i));
      }
      std::sort(expected.begin(), expected.end());
      const auto found = table.FindNearest<3>(query);
      for (size_t i = 0; i < 3; ++i) {
        if (i >= expected.size()) {
          EXPECT_EQ(found[i].row, -1);
          continue;
        }
        EXPECT_EQ(found[i].row, expected[i].second);
        EXPECT_EQ(found[i].squared, expected[i].first);
      }
      EXPECT_EQ(table.NearestSquared(query), expected.front().first);
    }
  }
}

}  // namespace
}  // namespace argmesh
