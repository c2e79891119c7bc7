#include "core/matching/assignment.h"

#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace argmesh {
namespace {

// One problem with rows <= cols, as costs = -profits. Dual prices keep
// cost(i, j) >= row_price[i] + column_price[j], with equality on assigned
// pairs, and 0 at columns that are free.
class Solver {
 public:
  Solver(std::span<const float> profits, size_t rows, size_t cols)
      : profits_(profits),
        rows_(rows),
        cols_(cols),
        row_price_(rows, 0.0),
        column_price_(cols, 0.0),
        column_of_row_(rows, -1),
        row_of_column_(cols, -1),
        shortest_(cols),
        from_row_(cols),
        done_(cols) {}

  std::vector<int32_t> Solve() {
    TakeFreeBestColumns();
    for (size_t row = 0; row < rows_; ++row) {
      if (column_of_row_[row] < 0) Augment(row);
    }
    return std::move(column_of_row_);
  }

 private:
  double Cost(size_t row, size_t col) const {
    return -static_cast<double>(profits_[row * cols_ + col]);
  }

  void TakeFreeBestColumns() {
    for (size_t row = 0; row < rows_; ++row) {
      size_t best = 0;
      for (size_t col = 1; col < cols_; ++col) {
        if (Cost(row, col) < Cost(row, best)) best = col;
      }
      row_price_[row] = Cost(row, best);
      if (row_of_column_[best] >= 0) continue;
      row_of_column_[best] = static_cast<int32_t>(row);
      column_of_row_[row] = static_cast<int32_t>(best);
    }
  }

  // Relaxes the columns reached from `row` at distance `base`; the nearest
  // column not yet done.
  size_t Relax(size_t row, double base) {
    size_t nearest = cols_;
    const double offset = base - row_price_[row];
    for (size_t col = 0; col < cols_; ++col) {
      if (done_[col] != 0) continue;
      const double length = offset + Cost(row, col) - column_price_[col];
      if (length < shortest_[col]) {
        shortest_[col] = length;
        from_row_[col] = static_cast<int32_t>(row);
      }
      if (nearest == cols_ || shortest_[col] < shortest_[nearest] ||
          (shortest_[col] == shortest_[nearest] && row_of_column_[col] < 0 &&
           row_of_column_[nearest] >= 0)) {
        nearest = col;
      }
    }
    return nearest;
  }

  // Dijkstra from `row` over alternating paths to the nearest free column.
  void Augment(size_t row) {
    shortest_.assign(cols_, std::numeric_limits<double>::infinity());
    done_.assign(cols_, 0);
    double base = 0;
    size_t at = row;
    while (true) {
      const size_t col = Relax(at, base);
      base = shortest_[col];
      done_[col] = 1;
      if (row_of_column_[col] < 0) {
        UpdatePrices(row, base);
        Flip(row, col);
        return;
      }
      at = static_cast<size_t>(row_of_column_[col]);
    }
  }

  void UpdatePrices(size_t row, double length) {
    row_price_[row] += length;
    for (size_t col = 0; col < cols_; ++col) {
      if (done_[col] == 0) continue;
      const double by = length - shortest_[col];
      column_price_[col] -= by;
      if (row_of_column_[col] >= 0) {
        row_price_[static_cast<size_t>(row_of_column_[col])] += by;
      }
    }
  }

  void Flip(size_t row, size_t col) {
    while (true) {
      const auto from = static_cast<size_t>(from_row_[col]);
      row_of_column_[col] = from_row_[col];
      const int32_t next =
          std::exchange(column_of_row_[from], static_cast<int32_t>(col));
      if (from == row) return;
      col = static_cast<size_t>(next);
    }
  }

  std::span<const float> profits_;
  size_t rows_, cols_;
  std::vector<double> row_price_, column_price_;
  std::vector<int32_t> column_of_row_, row_of_column_;
  std::vector<double> shortest_;
  std::vector<int32_t> from_row_;
  std::vector<char> done_;
};

}  // namespace

std::vector<int32_t> SolveAssignment(std::span<const float> profits, int rows,
                                     int cols) {
  const auto r = static_cast<size_t>(rows);
  const auto c = static_cast<size_t>(cols);
  if (r <= c) return Solver(profits, r, c).Solve();
  std::vector<float> transposed(r * c);
  for (size_t i = 0; i < r; ++i) {
    for (size_t j = 0; j < c; ++j) transposed[j * r + i] = profits[i * c + j];
  }
  const std::vector<int32_t> row_of_column = Solver(transposed, c, r).Solve();
  std::vector<int32_t> column_of_row(r, -1);
  for (size_t j = 0; j < c; ++j) {
    column_of_row[static_cast<size_t>(row_of_column[j])] =
        static_cast<int32_t>(j);
  }
  return column_of_row;
}

}  // namespace argmesh
