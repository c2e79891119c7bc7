#include "core/matching/assignment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <set>
#include <vector>

#include "core/base/random.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

double Profit(const std::vector<float>& profits, int cols,
              const std::vector<int32_t>& column_of_row) {
  double sum = 0;
  for (size_t i = 0; i < column_of_row.size(); ++i) {
    if (column_of_row[i] < 0) continue;
    sum += static_cast<double>(profits[i * static_cast<size_t>(cols) +
                                       static_cast<size_t>(column_of_row[i])]);
  }
  return sum;
}

// Over every injective assignment of the smaller side.
double BestByTrying(const std::vector<float>& profits, int rows, int cols) {
  std::vector<int32_t> order(static_cast<size_t>(std::max(rows, cols)));
  std::iota(order.begin(), order.end(), 0);
  double best = -1e30;
  do {
    double sum = 0;
    for (int k = 0; k < std::min(rows, cols); ++k) {
      const int i = rows <= cols ? k : order[static_cast<size_t>(k)];
      const int j = rows <= cols ? order[static_cast<size_t>(k)] : k;
      sum += static_cast<double>(profits[static_cast<size_t>(i * cols + j)]);
    }
    best = std::max(best, sum);
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

void ExpectInjective(const std::vector<int32_t>& column_of_row, int rows,
                     int cols) {
  ASSERT_EQ(column_of_row.size(), static_cast<size_t>(rows));
  std::set<int32_t> used;
  for (const int32_t col : column_of_row) {
    if (col < 0) continue;
    EXPECT_LT(col, cols);
    EXPECT_TRUE(used.insert(col).second) << "column " << col << " twice";
  }
  EXPECT_EQ(used.size(), static_cast<size_t>(std::min(rows, cols)));
}

TEST(SolveAssignment, LeavesTheGreedyChoiceForTheBetterSum) {
  // Greedy takes 9 and is left with 1; 8 + 7 is better.
  const std::vector<float> profits = {9, 8, 7, 1};
  EXPECT_THAT(SolveAssignment(profits, 2, 2), ElementsAre(1, 0));
}

TEST(SolveAssignment, EqualsTryingEverythingOnRandomProfits) {
  for (uint64_t seed = 0; seed < 600; ++seed) {
    Random random(seed);
    const int rows = static_cast<int>(1 + random.Below(6));
    const int cols = static_cast<int>(1 + random.Below(6));
    std::vector<float> profits(static_cast<size_t>(rows * cols));
    for (float& profit : profits) {
      // Every third problem is full of ties, every fifth has negative profits.
      profit = static_cast<float>(random.Uniform(seed % 5 == 0 ? -1 : 0, 1));
      if (seed % 3 == 0) profit = static_cast<float>(random.Below(3));
    }
    const std::vector<int32_t> solved = SolveAssignment(profits, rows, cols);
    ExpectInjective(solved, rows, cols);
    EXPECT_NEAR(Profit(profits, cols, solved),
                BestByTrying(profits, rows, cols), 1e-5)
        << "seed " << seed << ", " << rows << " x " << cols;
  }
}

TEST(SolveAssignment, SumsTheSameWhenTransposedAtTheSizeOfUniformCells) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    const int rows = 32;
    const int cols = 20 + static_cast<int>(seed);
    std::vector<float> profits(static_cast<size_t>(rows * cols));
    std::vector<float> transposed(profits.size());
    for (int i = 0; i < rows; ++i) {
      for (int j = 0; j < cols; ++j) {
        const auto profit = static_cast<float>(random.Uniform());
        profits[static_cast<size_t>(i * cols + j)] = profit;
        transposed[static_cast<size_t>(j * rows + i)] = profit;
      }
    }
    const std::vector<int32_t> solved = SolveAssignment(profits, rows, cols);
    ExpectInjective(solved, rows, cols);
    EXPECT_NEAR(
        Profit(profits, cols, solved),
        Profit(transposed, rows, SolveAssignment(transposed, cols, rows)), 1e-5)
        << "seed " << seed;
  }
}

TEST(SolveAssignment, FindsAHiddenPermutation) {
  Random random(5);
  const int n = 40;
  std::vector<int32_t> hidden(n);
  std::iota(hidden.begin(), hidden.end(), 0);
  for (size_t i = hidden.size(); i > 1; --i) {
    std::swap(hidden[i - 1], hidden[random.Below(i)]);
  }
  std::vector<float> profits(n * n);
  for (float& profit : profits) {
    profit = static_cast<float>(random.Uniform(0, 0.4));
  }
  for (size_t i = 0; i < hidden.size(); ++i) {
    profits[i * n + static_cast<size_t>(hidden[i])] = 1;
  }
  EXPECT_EQ(SolveAssignment(profits, n, n), hidden);
}

TEST(SolveAssignment, GivesTiesToTheLowerIndex) {
  EXPECT_THAT(SolveAssignment(std::vector<float>(9, 0.5F), 3, 3),
              ElementsAre(0, 1, 2));
}

TEST(SolveAssignment, HandlesSidesOfNothing) {
  EXPECT_THAT(SolveAssignment({}, 0, 4), IsEmpty());
  EXPECT_THAT(SolveAssignment({}, 2, 0), ElementsAre(-1, -1));
}

}  // namespace
}  // namespace argmesh
