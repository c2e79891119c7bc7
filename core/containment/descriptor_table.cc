#include "core/containment/descriptor_table.h"

#include <algorithm>

namespace argmesh {
namespace {

constexpr float kFar = 1e9F;

}  // namespace

float SquaredNorm(const WindowDescriptor& descriptor) {
  int32_t sum = 0;
  for (const int8_t x : descriptor) sum += x * x;
  return static_cast<float>(sum);
}

DescriptorTable::DescriptorTable(std::span<const WindowDescriptor> rows)
    : size_(rows.size()),
      values_((rows.size() + kBlock - 1) / kBlock * kWindowDims, Block{}),
      norms_((rows.size() + kBlock - 1) / kBlock) {
  for (Block& block : norms_) block.fill(kFar);
  for (size_t i = 0; i < rows.size(); ++i) {
    const size_t block = i / kBlock;
    norms_[block][i % kBlock] = SquaredNorm(rows[i]);
    for (size_t d = 0; d < kWindowDims; ++d) {
      values_[block * kWindowDims + d][i % kBlock] =
          static_cast<float>(rows[i][d]);
    }
  }
}

void DescriptorTable::Distances(const std::array<float, kWindowDims>& query,
                                float norm, size_t block,
                                Block& squared) const {
  Block products{};
  const Block* const values = &values_[block * kWindowDims];
  for (size_t d = 0; d < kWindowDims; ++d) {
    for (size_t j = 0; j < kBlock; ++j) products[j] += query[d] * values[d][j];
  }
  for (size_t j = 0; j < kBlock; ++j) {
    squared[j] = norm + norms_[block][j] - 2 * products[j];
  }
}

float DescriptorTable::NearestSquared(const WindowDescriptor& query) const {
  const std::array<float, kWindowDims> floats = ToFloats(query);
  const float norm = SquaredNorm(query);
  Block nearest;
  nearest.fill(4 * kFar);
  Block squared;
  for (size_t b = 0; b < norms_.size(); ++b) {
    Distances(floats, norm, b, squared);
    for (size_t j = 0; j < kBlock; ++j) {
      nearest[j] = std::min(nearest[j], squared[j]);
    }
  }
  return *std::min_element(nearest.begin(), nearest.end());
}

}  // namespace argmesh
