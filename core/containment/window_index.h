// An inverted index over the window words of a collection: which shapes may
// contain a query, from a few bits a shape.
//
// A value: a copy shares its blocks of 128 slots with the original, and a
// change copies the one block it falls in (0.3 MB) when it is shared. So a
// server changes one index and publishes copies.
//
// Score    S(t) = max over shifts k of sum w_i idf_i s_i(t, k) / sum w_i idf_i,
//          s_i by the distance of query window i to the nearest of its 3
//          nearest words that t has k levels on; idf_i falls with the share of
//          shapes, stored and of the codebook's training, that answer i too.
// Repeats  the same slots and words give equal bits, in whatever order they
//          came.
// Cost     Set, Erase: about 20 us. Vote: about 10 ms + 25 us a shape.
//          Const functions are thread-safe.
#ifndef ARGMESH_CORE_CONTAINMENT_WINDOW_INDEX_H_
#define ARGMESH_CORE_CONTAINMENT_WINDOW_INDEX_H_

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/base/stop_token.h"
#include "core/containment/window_set.h"
#include "core/containment/window_votes.h"
#include "core/containment/window_words.h"

namespace argmesh {

inline constexpr int64_t kMaxWindowSlot = 10'000'000;

// A query window as the index sees it.
struct SoftWindow;

struct VoteOptions {
  int limit = 150;       // shapes returned, >= 1
  bool flipped = false;  // look for the query turned inside out
  // By slot: those that may be returned. Null: all. Borrowed.
  const std::vector<bool>* slots = nullptr;
};

class WindowIndex {
 public:
  // Slots are dense numbers of the caller's, 0 .. kMaxWindowSlot. Takes the
  // place of what the slot stood for before.
  void Set(int64_t slot, const WindowWords& words);
  void Erase(int64_t slot);  // nothing when it is empty

  int64_t size() const { return size_; }

  // The best slots by score, descending, then by slot.
  // Fails kCancelled, kDeadlineExceeded.
  absl::StatusOr<VoteResult> Vote(const QueryWindows& query,
                                  const VoteOptions& options = {},
                                  const StopToken& stop = {}) const;

 private:
  struct Block;

  Block& MutableBlock(int64_t slot);
  absl::StatusOr<std::vector<double>> CommonShares(
      const std::vector<SoftWindow>& windows, const StopToken& stop) const;
  void VoteInBlock(size_t number, const std::vector<SoftWindow>& windows,
                   const std::vector<bool>* slots, VoteResult& result) const;

  std::vector<std::shared_ptr<Block>> blocks_;
  int64_t size_ = 0;
};

}  // namespace argmesh

#endif  // ARGMESH_CORE_CONTAINMENT_WINDOW_INDEX_H_
