// Distances from descriptors to all descriptors of a level.
//
// Laid out by dimension, as floats: sums of products of int8 stay below 2^24,
// so every order of adding gives the same bits.
#ifndef ARGMESH_CORE_CONTAINMENT_DESCRIPTOR_TABLE_H_
#define ARGMESH_CORE_CONTAINMENT_DESCRIPTOR_TABLE_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/containment/window_set.h"

namespace argmesh {

class DescriptorTable {
 public:
  DescriptorTable() = default;  // no rows
  explicit DescriptorTable(std::span<const WindowDescriptor> rows);

  size_t size() const { return size_; }

  struct Entry {
    int32_t row = -1;   // -1: the table has no more rows
    float squared = 0;  // in units of descriptors
  };

  // The squared distance to the nearest row; size() > 0.
  // Cost about 2 ns a row.
  float NearestSquared(const WindowDescriptor& query) const;

  // The nearest rows, ascending, ties by row.
  template <size_t kCount>
  std::array<Entry, kCount> FindNearest(const WindowDescriptor& query) const;

 private:
  static constexpr size_t kBlock = 16;
  using Block = Eigen::Array<float, static_cast<int>(kBlock), 1>;

  // Squared distances to the rows of a block; far for padding.
  void Distances(const std::array<float, kWindowDims>& query, float norm,
                 size_t block, Block& squared) const;

  size_t size_ = 0;
  std::vector<Block> values_;  // block, then dimension
  std::vector<Block> norms_;   // |row|^2; far for padding
};

inline std::array<float, kWindowDims> ToFloats(
    const WindowDescriptor& descriptor) {
  std::array<float, kWindowDims> floats;
  for (size_t d = 0; d < kWindowDims; ++d) {
    floats[d] = static_cast<float>(descriptor[d]);
  }
  return floats;
}

float SquaredNorm(const WindowDescriptor& descriptor);

template <size_t kCount>
std::array<DescriptorTable::Entry, kCount> DescriptorTable::FindNearest(
    const WindowDescriptor& query) const {
  const std::array<float, kWindowDims> floats = ToFloats(query);
  const float norm = SquaredNorm(query);
  std::array<Entry, kCount> best;
  size_t found = 0;
  Block squared;
  for (size_t b = 0; b * kBlock < size_; ++b) {
    Distances(floats, norm, b, squared);
    for (size_t j = 0; j < kBlock && b * kBlock + j < size_; ++j) {
      if (found == kCount &&
          squared[static_cast<Eigen::Index>(j)] >= best[kCount - 1].squared)
        continue;
      if (found < kCount) ++found;
      size_t at = found - 1;
      for (; at > 0 &&
             best[at - 1].squared > squared[static_cast<Eigen::Index>(j)];
           --at) {
        best[at] = best[at - 1];
      }
      best[at] = {static_cast<int32_t>(b * kBlock + j),
                  squared[static_cast<Eigen::Index>(j)]};
    }
  }
  return best;
}

}  // namespace argmesh

#endif  // ARGMESH_CORE_CONTAINMENT_DESCRIPTOR_TABLE_H_
