#include "core/abstraction/normalized_cut.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace argmesh {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMinMass = 1e-12;

struct Split {
  double value = kInfinity;
  std::vector<int32_t> sides[2];
};

// Members in the order of the second smallest eigenvector of (L, M).
std::vector<int32_t> OrderAlongSecondVector(const Eigen::MatrixXd& weights,
                                            const Eigen::VectorXd& masses) {
  const Eigen::VectorXd inverse_root = masses.cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd laplacian = -weights;
  laplacian.diagonal() = weights.rowwise().sum();
  const Eigen::MatrixXd scaled =
      inverse_root.asDiagonal() * laplacian * inverse_root.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled);
  const Eigen::VectorXd position =
      inverse_root.cwiseProduct(solver.eigenvectors().col(1));
  std::vector<int32_t> order(static_cast<size_t>(masses.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int32_t a, int32_t b) {
    return position[a] < position[b];
  });
  return order;
}

Split FindBestSplit(const CutProblem& problem,
                    const std::vector<int32_t>& members) {
  Split split;
  const auto k = static_cast<Eigen::Index>(members.size());
  if (k < 2) return split;
  Eigen::MatrixXd weights = problem.weights(members, members);
  weights.diagonal().setZero();
  const Eigen::VectorXd masses = problem.masses(members).cwiseMax(kMinMass);
  const std::vector<int32_t> order = OrderAlongSecondVector(weights, masses);

  const double total = masses.sum();
  double first_mass = 0;
  double cut = 0;
  size_t best_count = 1;
  std::vector<char> inside(members.size(), 0);
  for (size_t t = 0; t + 1 < order.size(); ++t) {
    const int32_t x = order[t];
    first_mass += masses[x];
    for (Eigen::Index j = 0; j < k; ++j) {
      cut +=
          inside[static_cast<size_t>(j)] != 0 ? -weights(x, j) : weights(x, j);
    }
    inside[static_cast<size_t>(x)] = 1;
    const double rest = std::max(total - first_mass, kMinMass);
    const double value =
        std::max(cut, 0.0) * (std::pow(first_mass, -problem.mass_exponent) +
                              std::pow(rest, -problem.mass_exponent));
    if (value < split.value) {
      split.value = value;
      best_count = t + 1;
    }
  }
  for (size_t t = 0; t < order.size(); ++t) {
    split.sides[t < best_count ? 0 : 1].push_back(
        members[static_cast<size_t>(order[t])]);
  }
  for (auto& side : split.sides) std::sort(side.begin(), side.end());
  // The side with the lower region number first: larger regions come first.
  if (split.sides[1].front() < split.sides[0].front()) {
    std::swap(split.sides[0], split.sides[1]);
  }
  return split;
}

// The leaves of a cut through the tree, refined step by step.
class Frontier {
 public:
  explicit Frontier(const std::vector<CutNode>& tree)
      : tree_(tree), leaves_({0}) {}

  void SplitUpTo(double threshold) {
    while (const int32_t* leaf = Cheapest()) {
      if (tree_[static_cast<size_t>(*leaf)].ncut > threshold) return;
      SplitLeaf(*leaf);
    }
  }

  void SplitToCount(int count) {
    while (static_cast<int>(leaves_.size()) < count) {
      const int32_t* leaf = Cheapest();
      if (leaf == nullptr) return;
      SplitLeaf(*leaf);
    }
  }

  DecompositionLevel Level() const {
    DecompositionLevel level;
    std::vector<int32_t> order = leaves_;
    std::sort(order.begin(), order.end(), [&](int32_t a, int32_t b) {
      return tree_[static_cast<size_t>(a)].regions.front() <
             tree_[static_cast<size_t>(b)].regions.front();
    });
    level.num_components = static_cast<int>(order.size());
    level.component_of_region.resize(tree_.front().regions.size());
    for (size_t c = 0; c < order.size(); ++c) {
      for (const int32_t r : tree_[static_cast<size_t>(order[c])].regions) {
        level.component_of_region[static_cast<size_t>(r)] =
            static_cast<int32_t>(c);
      }
    }
    return level;
  }

 private:
  const int32_t* Cheapest() const {
    const int32_t* best = nullptr;
    for (const int32_t& leaf : leaves_) {
      const CutNode& node = tree_[static_cast<size_t>(leaf)];
      if (node.children[0] < 0) continue;
      if (best == nullptr ||
          node.ncut < tree_[static_cast<size_t>(*best)].ncut) {
        best = &leaf;
      }
    }
    return best;
  }

  void SplitLeaf(int32_t leaf) {
    const CutNode& node = tree_[static_cast<size_t>(leaf)];
    *std::find(leaves_.begin(), leaves_.end(), leaf) = node.children[0];
    leaves_.push_back(node.children[1]);
  }

  const std::vector<CutNode>& tree_;
  std::vector<int32_t> leaves_;
};

void SetParents(DecompositionLevel& level, const DecompositionLevel* before) {
  level.parent.assign(static_cast<size_t>(level.num_components), -1);
  if (before == nullptr) return;
  for (size_t r = 0; r < level.component_of_region.size(); ++r) {
    level.parent[static_cast<size_t>(level.component_of_region[r])] =
        before->component_of_region[r];
  }
}

}  // namespace

std::vector<CutNode> BuildCutTree(const CutProblem& problem) {
  std::vector<CutNode> tree(1);
  tree[0].regions.resize(static_cast<size_t>(problem.masses.size()));
  std::iota(tree[0].regions.begin(), tree[0].regions.end(), 0);
  for (size_t at = 0; at < tree.size(); ++at) {
    Split split = FindBestSplit(problem, tree[at].regions);
    tree[at].ncut = split.value;
    if (split.sides[0].empty()) continue;
    for (int side = 0; side < 2; ++side) {
      tree[at].children[side] = static_cast<int32_t>(tree.size());
      tree.emplace_back();
      tree.back().regions = std::move(split.sides[side]);
    }
  }
  return tree;
}

std::vector<DecompositionLevel> CutLevels(const std::vector<CutNode>& tree,
                                          const std::vector<double>& thresholds,
                                          const std::vector<int>& counts) {
  Frontier frontier(tree);
  std::vector<DecompositionLevel> levels;
  const auto add = [&](double threshold, int count) {
    DecompositionLevel level = frontier.Level();
    level.threshold = threshold;
    level.count = count;
    SetParents(level, levels.empty() ? nullptr : &levels.back());
    levels.push_back(std::move(level));
  };
  for (const double threshold : thresholds) {
    frontier.SplitUpTo(threshold);
    add(threshold, 0);
  }
  for (const int count : counts) {
    frontier.SplitToCount(count);
    add(0, count);
  }
  return levels;
}

}  // namespace argmesh
