#include "core/containment/descriptor_table.h"

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
      values_((rows.size() + kBlock - 1) / kBlock * kWindowDims, Block::Zero()),
      norms_((rows.size() + kBlock - 1) / kBlock, Block::Constant(kFar)) {
  for (size_t i = 0; i < rows.size(); ++i) {
    const size_t block = i / kBlock;
    const auto at = static_cast<Eigen::Index>(i % kBlock);
    norms_[block][at] = SquaredNorm(rows[i]);
    for (size_t d = 0; d < kWindowDims; ++d) {
      values_[block * kWindowDims + d][at] = static_cast<float>(rows[i][d]);
    }
  }
}

void DescriptorTable::Distances(const std::array<float, kWindowDims>& query,
                                float norm, size_t block,
                                Block& squared) const {
  Block products = Block::Zero();
  const Block* const values = &values_[block * kWindowDims];
  for (size_t d = 0; d < kWindowDims; ++d) products += query[d] * values[d];
  squared = norms_[block] + norm - 2 * products;
}

float DescriptorTable::NearestSquared(const WindowDescriptor& query) const {
  const std::array<float, kWindowDims> floats = ToFloats(query);
  const float norm = SquaredNorm(query);
  Block nearest = Block::Constant(4 * kFar);
  Block squared;
  for (size_t b = 0; b < norms_.size(); ++b) {
    Distances(floats, norm, b, squared);
    nearest = nearest.min(squared);
  }
  return nearest.minCoeff();
}

}  // namespace argmesh
