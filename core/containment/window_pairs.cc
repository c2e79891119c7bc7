#include "core/containment/window_pairs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/containment/query_weights.h"
#include "core/containment/window_codebook.h"

namespace argmesh {
namespace {

constexpr size_t kCandidates = 3;
constexpr float kPairSigma = 0.5F;
constexpr float kMinLikeness = 0.02F;
constexpr float kMinBaseline = 0.2F;     // of the query's size
constexpr float kMaxScaleRatio = 1.43F;  // to the shift's scale
constexpr float kMaxTiltError = 0.35F;   // of cosines to the baseline
constexpr float kMaxBendError = 0.4F;    // of the cosine of both normals
constexpr float kMinBothAcross = 0.4F;   // lengths that a frame can rest on
constexpr float kMinOneAcross = 0.3F;

// Two oriented points.
struct Pair {
  Eigen::Vector3f a, b;
  Eigen::Vector3f normal_a, normal_b;
};

Eigen::Vector3f Across(const Eigen::Vector3f& x, const Eigen::Vector3f& axis) {
  return x - axis * x.dot(axis);
}

Eigen::Matrix3f Frame(const Eigen::Vector3f& axis,
                      const Eigen::Vector3f& across) {
  Eigen::Matrix3f frame;
  frame.col(0) = axis;
  frame.col(1) = across.normalized();
  frame.col(2) = axis.cross(frame.col(1));
  return frame;
}

// The transform that takes `from` to `to`, when one nearly does.
std::optional<Similarity> Fit(const Pair& from, const Pair& to,
                              float expected_scale) {
  const float from_length = (from.b - from.a).norm();
  const float to_length = (to.b - to.a).norm();
  if (from_length < kMinBaseline) return std::nullopt;
  const float scale = to_length / from_length;
  if (scale < expected_scale / kMaxScaleRatio ||
      scale > expected_scale * kMaxScaleRatio) {
    return std::nullopt;
  }
  const Eigen::Vector3f d = (from.b - from.a) / from_length;
  const Eigen::Vector3f e = (to.b - to.a) / to_length;
  if (std::abs(from.normal_a.dot(d) - to.normal_a.dot(e)) > kMaxTiltError ||
      std::abs(from.normal_b.dot(d) - to.normal_b.dot(e)) > kMaxTiltError ||
      std::abs(from.normal_a.dot(from.normal_b) -
               to.normal_a.dot(to.normal_b)) > kMaxBendError) {
    return std::nullopt;
  }
  Eigen::Vector3f from_across = Across(from.normal_a + from.normal_b, d);
  Eigen::Vector3f to_across = Across(to.normal_a + to.normal_b, e);
  if (from_across.norm() < kMinBothAcross ||
      to_across.norm() < kMinBothAcross) {
    from_across = Across(from.normal_a, d);
    to_across = Across(to.normal_a, e);
    if (from_across.norm() < kMinOneAcross ||
        to_across.norm() < kMinOneAcross) {
      return std::nullopt;
    }
  }
  Similarity place;
  place.rotation = Frame(e, to_across) * Frame(d, from_across).transpose();
  place.scale = scale;
  place.shift =
      (to.a + to.b) / 2 - scale * (place.rotation * ((from.a + from.b) / 2));
  return place;
}

}  // namespace

WindowPairs::WindowPairs(const QueryWindows& query,
                         std::span<const float> weights, bool flipped,
                         const PreparedTarget& target, int shift)
    : flipped_(flipped), expected_scale_(ShiftScale(shift)) {
  size_t next = 0;
  for (size_t l = 0; l < query.levels.size(); ++l) {
    const std::optional<size_t> met = MetLevel(l, shift);
    const std::vector<QueryWindow>& windows = query.levels[l].windows;
    const size_t first = next;
    next += windows.size();
    if (!met) continue;
    const PreparedLevel& level = target.levels[*met];
    if (level.descriptors.size() == 0) continue;
    for (size_t i = 0; i < windows.size(); ++i) {
      const QueryWindow& window = windows[i];
      const double weight =
          first + i < weights.size() ? weights[first + i] : 1.0;
      Add(window, weight, level);
    }
  }
}

void WindowPairs::Add(const QueryWindow& window, double weight,
                      const PreparedLevel& level) {
  const float unit = DefaultWindowCodebook().unit;
  const float falloff = -1 / (2 * kPairSigma * kPairSigma * unit * unit);
  double total = cumulative_.empty() ? 0 : cumulative_.back();
  const auto nearest = level.descriptors.FindNearest<kCandidates>(
      DescriptorOf(window, flipped_));
  for (const DescriptorTable::Entry& entry : nearest) {
    if (entry.row < 0) continue;
    const float likeness = std::exp(falloff * entry.squared);
    if (likeness < kMinLikeness) continue;
    const auto row = static_cast<size_t>(entry.row);
    matches_.push_back({&window, level.positions[row], level.normals[row]});
    total += weight * likeness * likeness;
    cumulative_.push_back(total);
  }
}

const WindowMatch& WindowPairs::DrawMatch(Random& random) const {
  const double at = random.Uniform() * cumulative_.back();
  const auto drawn =
      std::lower_bound(cumulative_.begin(), cumulative_.end(), at);
  const auto index = std::min<size_t>(
      static_cast<size_t>(drawn - cumulative_.begin()), matches_.size() - 1);
  return matches_[index];
}

std::optional<Similarity> WindowPairs::Draw(Random& random) const {
  const WindowMatch& a = DrawMatch(random);
  const WindowMatch& b = DrawMatch(random);
  if (a.query == b.query) return std::nullopt;
  const float side = flipped_ ? -1.0F : 1.0F;
  const Pair from{a.query->position, b.query->position, side * a.query->normal,
                  side * b.query->normal};
  const Pair to{a.target_position, b.target_position, a.target_normal,
                b.target_normal};
  return Fit(from, to, expected_scale_);
}

}  // namespace argmesh
