#include "core/synthesis/surface_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace argmesh {
namespace {

constexpr int kCoarse = 4;  // blocks along a coarse block
constexpr double kHalfDiagonal = 0.8660254037844386;
// Slack for distances that are only nearly exact.
constexpr double kSkipSlack = 1.3;

}  // namespace

SurfaceGrid::SurfaceGrid(const ImplicitSurface& surface, double cell)
    : surface_(surface), cell_(cell), all_terms_(surface.AllTerms()) {
  const Eigen::AlignedBox3d bounds = surface.Bounds();
  const double block_length = cell * kBlock;
  origin_ = bounds.min().array() - 1.25 * block_length;
  size_t count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    const double length = bounds.sizes()[axis] + 2.5 * block_length;
    const int coarse =
        static_cast<int>(std::ceil(length / (block_length * kCoarse)));
    size_[a] = coarse * kCoarse;
    count *= static_cast<size_t>(size_[a]);
  }
  slot_.assign(count, -1);
  sign_.assign(count, 1);
  for (int z = 0; z < size_[2]; z += kCoarse) {
    for (int y = 0; y < size_[1]; y += kCoarse) {
      for (int x = 0; x < size_[0]; x += kCoarse) VisitCoarseBlock({x, y, z});
    }
  }
  GrowToClosure();
  SortBlocks();
}

Eigen::Vector3d SurfaceGrid::Position(const GridCorner& corner) const {
  return origin_ + cell_ * Eigen::Vector3d(corner[0], corner[1], corner[2]);
}

size_t SurfaceGrid::BlockNumber(const GridCorner& block) const {
  const int64_t row = int64_t{block[2]} * size_[1] + block[1];
  return static_cast<size_t>(row * size_[0] + block[0]);
}

bool SurfaceGrid::Contains(const GridCorner& block) const {
  for (size_t axis = 0; axis < 3; ++axis) {
    if (block[axis] < 0 || block[axis] >= size_[axis]) return false;
  }
  return true;
}

int64_t SurfaceGrid::Key(const GridCorner& corner) const {
  // One cell of margin below, where cells touch the first corners.
  const int64_t width = size_[0] * kBlock + 2;
  const int64_t depth = size_[1] * kBlock + 2;
  return ((corner[2] + 1) * depth + corner[1] + 1) * width + corner[0] + 1;
}

float SurfaceGrid::Value(const GridCorner& corner) const {
  const GridCorner block = {corner[0] >> 2, corner[1] >> 2, corner[2] >> 2};
  if (!Contains(block)) return static_cast<float>(cell_);
  const size_t number = BlockNumber(block);
  const int32_t slot = slot_[number];
  if (slot < 0) return static_cast<float>(cell_ * sign_[number]);
  const int index =
      ((corner[2] & 3) * kBlock + (corner[1] & 3)) * kBlock + (corner[0] & 3);
  return stored_[static_cast<size_t>(slot)].values[static_cast<size_t>(index)];
}

std::span<const int32_t> SurfaceGrid::Terms(const GridCorner& corner) const {
  const GridCorner block = {corner[0] >> 2, corner[1] >> 2, corner[2] >> 2};
  const int32_t slot = Contains(block) ? slot_[BlockNumber(block)] : -1;
  if (slot < 0) return all_terms_;
  return stored_[static_cast<size_t>(slot)].terms;
}

void SurfaceGrid::VisitCoarseBlock(const GridCorner& coarse) {
  constexpr int kLength = kBlock * kCoarse;
  const Eigen::Vector3d center =
      Position({coarse[0] * kBlock, coarse[1] * kBlock, coarse[2] * kBlock})
          .array() +
      0.5 * kLength * cell_;
  const double radius = kHalfDiagonal * kLength * cell_;
  double distance = 0;
  const std::vector<int32_t> terms =
      surface_.TermsNear(center, radius, all_terms_, &distance);
  const bool passes = std::abs(distance) <= kSkipSlack * radius;
  for (int z = 0; z < kCoarse; ++z) {
    for (int y = 0; y < kCoarse; ++y) {
      for (int x = 0; x < kCoarse; ++x) {
        const GridCorner block = {coarse[0] + x, coarse[1] + y, coarse[2] + z};
        if (passes) {
          VisitBlock(block, terms);
        } else {
          sign_[BlockNumber(block)] = distance < 0 ? -1 : 1;
        }
      }
    }
  }
}

void SurfaceGrid::VisitBlock(const GridCorner& block,
                             std::span<const int32_t> terms) {
  const Eigen::Vector3d center =
      Position({block[0] * kBlock, block[1] * kBlock, block[2] * kBlock})
          .array() +
      0.5 * kBlock * cell_;
  const double radius = kHalfDiagonal * kBlock * cell_;
  double distance = 0;
  std::vector<int32_t> near =
      surface_.TermsNear(center, radius, terms, &distance);
  if (std::abs(distance) <= kSkipSlack * radius) {
    EvaluateBlock(block, std::move(near));
  } else {
    sign_[BlockNumber(block)] = distance < 0 ? -1 : 1;
  }
}

void SurfaceGrid::EvaluateBlock(const GridCorner& block,
                                std::vector<int32_t> terms) {
  Block evaluated;
  size_t index = 0;
  for (int z = 0; z < kBlock; ++z) {
    for (int y = 0; y < kBlock; ++y) {
      for (int x = 0; x < kBlock; ++x) {
        const double distance = surface_.Distance(
            Position({block[0] * kBlock + x, block[1] * kBlock + y,
                      block[2] * kBlock + z}),
            terms);
        const auto value = static_cast<float>(distance);
        evaluated.values[index++] = value == 0.0F ? 1e-20F : value;
      }
    }
  }
  evaluated.terms = std::move(terms);
  slot_[BlockNumber(block)] = static_cast<int32_t>(stored_.size());
  stored_.push_back(std::move(evaluated));
  blocks_.push_back(block);
}

bool SurfaceGrid::DisagreesWithNeighbor(const GridCorner& block, int axis,
                                        int side) const {
  const auto a = static_cast<size_t>(axis);
  GridCorner neighbor = block;
  neighbor[a] += side == 0 ? -1 : 1;
  if (!Contains(neighbor) || slot_[BlockNumber(neighbor)] >= 0) return false;
  const bool outside = sign_[BlockNumber(neighbor)] > 0;
  GridCorner corner = {block[0] * kBlock, block[1] * kBlock, block[2] * kBlock};
  corner[a] += side == 0 ? 0 : kBlock - 1;
  const size_t u = (a + 1) % 3;
  const size_t v = (a + 2) % 3;
  for (int i = 0; i < kBlock * kBlock; ++i) {
    GridCorner at = corner;
    at[u] += i % kBlock;
    at[v] += i / kBlock;
    if (Inside(at) == outside) return true;
  }
  return false;
}

void SurfaceGrid::GrowToClosure() {
  for (size_t i = 0; i < blocks_.size(); ++i) {  // blocks_ grows meanwhile
    for (int direction = 0; direction < 6; ++direction) {
      const GridCorner block = blocks_[i];
      const int axis = direction / 2;
      if (!DisagreesWithNeighbor(block, axis, direction % 2)) continue;
      GridCorner neighbor = block;
      neighbor[static_cast<size_t>(axis)] += direction % 2 == 0 ? -1 : 1;
      EvaluateBlock(neighbor, all_terms_);
    }
  }
}

void SurfaceGrid::SortBlocks() {
  std::sort(blocks_.begin(), blocks_.end(),
            [this](const GridCorner& a, const GridCorner& b) {
              return BlockNumber(a) < BlockNumber(b);
            });
  for (GridCorner& block : blocks_) {
    for (int& coordinate : block) coordinate *= kBlock;
  }
}

double SurfaceGrid::EstimateArea() const {
  int64_t near = 0;
  for (const Block& block : stored_) {
    near += std::count_if(block.values.begin(), block.values.end(),
                          [&](float v) { return std::abs(v) < 0.5 * cell_; });
  }
  return static_cast<double>(near) * cell_ * cell_;
}

}  // namespace argmesh
