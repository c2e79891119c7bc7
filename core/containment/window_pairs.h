// Places of a query on a target that two pairs of matching windows agree on.
#ifndef ARGMESH_CORE_CONTAINMENT_WINDOW_PAIRS_H_
#define ARGMESH_CORE_CONTAINMENT_WINDOW_PAIRS_H_

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "core/base/random.h"
#include "core/containment/prepared_target.h"
#include "core/containment/similarity.h"
#include "core/containment/window_set.h"

namespace argmesh {

// A window of the query and one of the target that looks alike.
struct WindowMatch {
  const QueryWindow* query = nullptr;
  Eigen::Vector3f target_position;
  Eigen::Vector3f target_normal;
};

class WindowPairs {
 public:
  // The three nearest target windows of each query window under a shift.
  // `weights` of query windows as in VoteResult; empty: all the same.
  WindowPairs(const QueryWindows& query, std::span<const float> weights,
              bool flipped, const PreparedTarget& target, int shift);

  float expected_scale() const { return expected_scale_; }
  bool empty() const { return matches_.size() < 3; }

  // The place that two drawn matches agree on, if they do: alike windows and
  // heavy ones are drawn more often; distances and angles between them must
  // correspond.
  std::optional<Similarity> Draw(Random& random) const;

 private:
  // The window's matches on one level.
  void Add(const QueryWindow& window, double weight,
           const PreparedLevel& level);
  const WindowMatch& DrawMatch(Random& random) const;

  bool flipped_;
  float expected_scale_;
  std::vector<WindowMatch> matches_;
  std::vector<double> cumulative_;
};

}  // namespace argmesh

#endif  // ARGMESH_CORE_CONTAINMENT_WINDOW_PAIRS_H_
