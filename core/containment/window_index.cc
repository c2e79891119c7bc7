#include "core/containment/window_index.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/base/status_macros.h"
#include "core/containment/query_weights.h"
#include "core/containment/window_codebook.h"
#include "core/containment/word_table.h"

namespace argmesh {
namespace {

constexpr size_t kSlots = 128;  // of a block
constexpr size_t kSoftWords = 3;
constexpr double kWordSigma = 0.35;
// The codebook's training counts in the shares as so many stored shapes.
constexpr double kTrainingShapes = 32;

using SlotBits = std::array<uint64_t, 2>;

constexpr size_t Count(const SlotBits& bits) {
  return static_cast<size_t>(std::popcount(bits[0])) +
         static_cast<size_t>(std::popcount(bits[1]));
}

template <typename Visit>
void ForEachSlot(const SlotBits& bits, const Visit& visit) {
  for (size_t half = 0; half < 2; ++half) {
    for (uint64_t rest = bits[half]; rest != 0; rest &= rest - 1) {
      visit(half * 64 + static_cast<size_t>(std::countr_zero(rest)));
    }
  }
}

}  // namespace

struct SoftWindow {
  size_t level = 0;
  std::array<size_t, kSoftWords> words{};
  std::array<float, kSoftWords> similarity{};  // descending
};

namespace {

std::vector<SoftWindow> AssignSoftly(const QueryWindows& query, bool flipped) {
  const DescriptorTable& table = DefaultWordTable();
  const double unit = DefaultWindowCodebook().unit;
  std::vector<SoftWindow> windows;
  for (size_t l = 0; l < query.levels.size(); ++l) {
    for (const QueryWindow& window : query.levels[l].windows) {
      const auto nearest =
          table.FindNearest<kSoftWords>(DescriptorOf(window, flipped));
      SoftWindow soft;
      soft.level = l;
      for (size_t i = 0; i < kSoftWords; ++i) {
        soft.words[i] = static_cast<size_t>(nearest[i].row);
        soft.similarity[i] = static_cast<float>(std::exp(
            -nearest[i].squared / (2 * kWordSigma * kWordSigma * unit * unit)));
      }
      windows.push_back(soft);
    }
  }
  return windows;
}

// The mean similarity over training shapes, as if words came independently.
double TrainingMean(const SoftWindow& window, size_t level) {
  const auto& share = DefaultWindowCodebook().share[level];
  double mean = 0;
  double none_yet = 1;
  for (size_t i = 0; i < kSoftWords; ++i) {
    const double has = share[window.words[i]] / 255.0;
    mean += none_yet * has * window.similarity[i];
    none_yet *= 1 - has;
  }
  return mean;
}

}  // namespace

struct WindowIndex::Block {
  SlotBits used{};
  // [level * kNumWindowWords + word]
  std::vector<SlotBits> bits =
      std::vector<SlotBits>(kNumTargetLevels * kNumWindowWords);

  // Slots by the nearest word of the window that they have at `level`.
  std::array<SlotBits, kSoftWords> Answers(const SoftWindow& window,
                                           size_t level) const {
    std::array<SlotBits, kSoftWords> answers;
    SlotBits seen{};
    for (size_t i = 0; i < kSoftWords; ++i) {
      const SlotBits& has = bits[level * kNumWindowWords + window.words[i]];
      for (size_t half = 0; half < 2; ++half) {
        answers[i][half] = has[half] & ~seen[half];
        seen[half] |= has[half];
      }
    }
    return answers;
  }
};

namespace {

// w_i idf_i of every window.
VoteResult WeighWindows(const QueryWindows& query,
                        const std::vector<SoftWindow>& windows,
                        const std::vector<double>& common) {
  VoteResult result;
  result.weights = WindowWeights(query);
  double unweighted = 0;
  for (size_t i = 0; i < windows.size(); ++i) {
    unweighted += result.weights[i];
    result.weights[i] *= static_cast<float>(std::max(0.0, 1 - common[i]));
    result.total_weight += result.weights[i];
  }
  if (unweighted > 0) result.distinctiveness = result.total_weight / unweighted;
  return result;
}

// The slots of block `number` that may be returned.
SlotBits ReturnedSlots(const SlotBits& used, size_t number,
                       const std::vector<bool>* slots) {
  if (slots == nullptr) return used;
  SlotBits returned = used;
  ForEachSlot(used, [&](size_t slot) {
    const size_t at = number * kSlots + slot;
    if (at >= slots->size() || !(*slots)[at]) {
      returned[slot / 64] &= ~(uint64_t{1} << (slot % 64));
    }
  });
  return returned;
}

}  // namespace

WindowIndex::Block& WindowIndex::MutableBlock(int64_t slot) {
  assert(slot >= 0 && slot <= kMaxWindowSlot);
  const size_t block = static_cast<size_t>(slot) / kSlots;
  if (block >= blocks_.size()) blocks_.resize(block + 1);
  std::shared_ptr<Block>& shared = blocks_[block];
  if (shared == nullptr) {
    shared = std::make_shared<Block>();
  } else if (shared.use_count() > 1) {
    shared = std::make_shared<Block>(*shared);
  }
  return *shared;
}

void WindowIndex::Erase(int64_t slot) {
  const size_t at = static_cast<size_t>(slot) % kSlots;
  const uint64_t bit = uint64_t{1} << (at % 64);
  const size_t block = static_cast<size_t>(slot) / kSlots;
  if (slot < 0 || block >= blocks_.size() || blocks_[block] == nullptr ||
      (blocks_[block]->used[at / 64] & bit) == 0) {
    return;
  }
  Block& changed = MutableBlock(slot);
  changed.used[at / 64] &= ~bit;
  for (SlotBits& bits : changed.bits) bits[at / 64] &= ~bit;
  --size_;
}

void WindowIndex::Set(int64_t slot, const WindowWords& words) {
  Erase(slot);
  Block& block = MutableBlock(slot);
  const size_t at = static_cast<size_t>(slot) % kSlots;
  const uint64_t bit = uint64_t{1} << (at % 64);
  block.used[at / 64] |= bit;
  for (size_t l = 0; l < words.levels.size(); ++l) {
    for (const uint16_t word : words.levels[l]) {
      assert(word < kNumWindowWords);
      block.bits[l * kNumWindowWords + word][at / 64] |= bit;
    }
  }
  ++size_;
}

// The share of shapes that answer each window, at the shift where it is
// largest.
absl::StatusOr<std::vector<double>> WindowIndex::CommonShares(
    const std::vector<SoftWindow>& windows, const StopToken& stop) const {
  std::vector<double> common(windows.size(), 0);
  for (size_t i = 0; i < windows.size(); ++i) {
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    for (int shift = 0; shift < kNumShifts; ++shift) {
      const std::optional<size_t> level = MetLevel(windows[i].level, shift);
      if (!level) continue;
      std::array<size_t, kSoftWords> counts{};
      for (const auto& block : blocks_) {
        if (block == nullptr) continue;
        const auto answers = block->Answers(windows[i], *level);
        for (size_t r = 0; r < kSoftWords; ++r) counts[r] += Count(answers[r]);
      }
      double sum = kTrainingShapes * TrainingMean(windows[i], *level);
      for (size_t r = 0; r < kSoftWords; ++r) {
        sum += static_cast<double>(counts[r]) * windows[i].similarity[r];
      }
      common[i] = std::max(
          common[i], sum / (kTrainingShapes + static_cast<double>(size_)));
    }
  }
  return common;
}

void WindowIndex::VoteInBlock(size_t number,
                              const std::vector<SoftWindow>& windows,
                              const std::vector<bool>* slots,
                              VoteResult& result) const {
  const Block& block = *blocks_[number];
  const SlotBits returned = ReturnedSlots(block.used, number, slots);
  if (Count(returned) == 0) return;
  std::array<std::array<float, kNumShifts>, kSlots> sums{};
  for (size_t i = 0; i < windows.size(); ++i) {
    for (int shift = 0; shift < kNumShifts; ++shift) {
      const std::optional<size_t> level = MetLevel(windows[i].level, shift);
      if (!level) continue;
      const auto answers = block.Answers(windows[i], *level);
      for (size_t r = 0; r < kSoftWords; ++r) {
        const float vote = result.weights[i] * windows[i].similarity[r];
        ForEachSlot(answers[r], [&](size_t slot) {
          sums[slot][static_cast<size_t>(shift)] += vote;
        });
      }
    }
  }
  ForEachSlot(returned, [&](size_t slot) {
    ShapeVotes votes;
    votes.slot = static_cast<int64_t>(number * kSlots + slot);
    for (size_t shift = 0; shift < kNumShifts; ++shift) {
      votes.by_shift[shift] =
          result.total_weight > 0
              ? static_cast<float>(sums[slot][shift] / result.total_weight)
              : 0;
      votes.score = std::max<double>(votes.score, votes.by_shift[shift]);
    }
    result.shapes.push_back(votes);
  });
}

absl::StatusOr<VoteResult> WindowIndex::Vote(const QueryWindows& query,
                                             const VoteOptions& options,
                                             const StopToken& stop) const {
  const std::vector<SoftWindow> windows = AssignSoftly(query, options.flipped);
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<double> common,
                           CommonShares(windows, stop));
  VoteResult result = WeighWindows(query, windows, common);
  for (size_t b = 0; b < blocks_.size(); ++b) {
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    if (blocks_[b] != nullptr) VoteInBlock(b, windows, options.slots, result);
  }
  const size_t kept = std::min(result.shapes.size(),
                               static_cast<size_t>(std::max(1, options.limit)));
  std::partial_sort(
      result.shapes.begin(),
      result.shapes.begin() + static_cast<std::ptrdiff_t>(kept),
      result.shapes.end(), [](const ShapeVotes& a, const ShapeVotes& b) {
        return a.score != b.score ? a.score > b.score : a.slot < b.slot;
      });
  result.shapes.resize(kept);
  return result;
}

}  // namespace argmesh
