#include "core/abstraction/mean_shift.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr int kShiftSteps = 30;
constexpr int kGrowSteps = 40;
constexpr float kConvergedShare = 0.01F;  // of the window
constexpr int kBlock = 64;  // points shifted together, to stay in cache

// Moves columns of `positions` to where the mean of their window is
// themselves, and notes the mass in the window there.
class Shifter {
 public:
  Shifter(const Eigen::MatrixXf& points, const Eigen::VectorXf& masses)
      : points_(points),
        masses_(masses),
        squared_norms_(points.colwise().squaredNorm()) {}

  void Shift(float window, int max_steps, Eigen::MatrixXf& positions,
             Eigen::VectorXf& densities) const {
    densities.resize(positions.cols());
    for (Eigen::Index first = 0; first < positions.cols(); first += kBlock) {
      const Eigen::Index count =
          std::min<Eigen::Index>(kBlock, positions.cols() - first);
      ShiftBlock(window, max_steps, first, count, positions, densities);
    }
  }

 private:
  void ShiftBlock(float window, int max_steps, Eigen::Index first,
                  Eigen::Index count, Eigen::MatrixXf& positions,
                  Eigen::VectorXf& densities) const {
    const float scale = -0.5F / (window * window);
    std::vector<Eigen::Index> active(static_cast<size_t>(count));
    std::iota(active.begin(), active.end(), first);
    for (int step = 0; step < max_steps && !active.empty(); ++step) {
      const Eigen::MatrixXf y = positions(Eigen::all, active);
      Eigen::MatrixXf kernel = -2.0F * (points_.transpose() * y);
      kernel.colwise() += squared_norms_;
      kernel.rowwise() += y.colwise().squaredNorm();
      // The floor keeps the exponential in its fast range; e^-50 is no mass.
      kernel = (kernel.array() * scale).min(0.0F).max(-50.0F);
      kernel = kernel.array().exp();
      kernel.array().colwise() *= masses_.array();
      const Eigen::RowVectorXf sums = kernel.colwise().sum();
      const Eigen::MatrixXf means = points_ * kernel;
      std::vector<Eigen::Index> moving;
      for (size_t i = 0; i < active.size(); ++i) {
        const auto column = static_cast<Eigen::Index>(i);
        const float sum = std::max(sums[column], 1e-30F);
        const Eigen::VectorXf next = means.col(column) / sum;
        const float moved = (next - y.col(column)).norm();
        positions.col(active[i]) = next;
        densities[active[i]] = sum;
        if (moved >= kConvergedShare * window) moving.push_back(active[i]);
      }
      active = std::move(moving);
    }
  }

  const Eigen::MatrixXf& points_;
  const Eigen::VectorXf& masses_;
  const Eigen::VectorXf squared_norms_;
};

std::vector<int32_t> OrderByDensity(const std::vector<int32_t>& items,
                                    const Eigen::VectorXf& densities) {
  std::vector<int32_t> order = items;
  std::stable_sort(order.begin(), order.end(), [&](int32_t a, int32_t b) {
    return densities[a] > densities[b];
  });
  return order;
}

struct Fused {
  std::vector<int32_t> owner_of_point;  // index into representatives
  std::vector<int32_t> representatives;
};

// In order of density: to the nearest earlier one closer than half a window,
// else a representative of its own.
Fused FuseConverged(const Eigen::MatrixXf& positions,
                    const Eigen::VectorXf& densities, float window) {
  std::vector<int32_t> all(static_cast<size_t>(positions.cols()));
  std::iota(all.begin(), all.end(), 0);
  Fused fused;
  fused.owner_of_point.assign(all.size(), -1);
  for (const int32_t p : OrderByDensity(all, densities)) {
    float best = 0.5F * window;
    int32_t owner = -1;
    for (size_t r = 0; r < fused.representatives.size(); ++r) {
      const float distance =
          (positions.col(p) - positions.col(fused.representatives[r])).norm();
      if (distance < best) {
        best = distance;
        owner = static_cast<int32_t>(r);
      }
    }
    if (owner < 0) {
      owner = static_cast<int32_t>(fused.representatives.size());
      fused.representatives.push_back(p);
    }
    fused.owner_of_point[static_cast<size_t>(p)] = owner;
  }
  return fused;
}

// The window ladder: the modes that still stand, and who swallowed the others.
class WindowLadder {
 public:
  WindowLadder(const Shifter& shifter, Eigen::MatrixXf centers,
               MeanShiftResult& result)
      : shifter_(shifter), centers_(std::move(centers)), result_(result) {
    live_.resize(result.modes.size());
    std::iota(live_.begin(), live_.end(), 0);
    result.survivor_of_mode = live_;
  }

  void Climb(float window) {
    if (live_.size() < 2) return;
    Eigen::MatrixXf moved = centers_(Eigen::all, live_);
    Eigen::VectorXf live_densities;
    shifter_.Shift(window, kGrowSteps, moved, live_densities);
    std::vector<int32_t> slots(live_.size());
    std::iota(slots.begin(), slots.end(), 0);
    std::vector<int32_t> kept;
    for (const int32_t slot : OrderByDensity(slots, live_densities)) {
      const int32_t mode = live_[static_cast<size_t>(slot)];
      const int32_t rival = NearestWithin(moved, kept, slot, 0.5F * window);
      const float offset = (moved.col(slot) - centers_.col(mode)).norm();
      ShiftedMode& state = result_.modes[static_cast<size_t>(mode)];
      state.offset = offset / window;
      if (rival >= 0) {
        Replace(mode, live_[static_cast<size_t>(rival)]);
        continue;
      }
      kept.push_back(slot);
      state.window = window;
      state.repeatability += 1;
      state.density = live_densities[slot];
    }
    std::sort(kept.begin(), kept.end());
    std::vector<int32_t> still_live;
    for (const int32_t slot : kept) {
      still_live.push_back(live_[static_cast<size_t>(slot)]);
      centers_.col(still_live.back()) = moved.col(slot);
    }
    live_ = std::move(still_live);
  }

 private:
  static int32_t NearestWithin(const Eigen::MatrixXf& positions,
                               const std::vector<int32_t>& kept, int32_t slot,
                               float radius) {
    int32_t nearest = -1;
    for (const int32_t other : kept) {
      const float distance =
          (positions.col(other) - positions.col(slot)).norm();
      if (distance < radius) {
        radius = distance;
        nearest = other;
      }
    }
    return nearest;
  }

  void Replace(int32_t mode, int32_t survivor) {
    for (int32_t& s : result_.survivor_of_mode) {
      if (s == mode) s = survivor;
    }
  }

  const Shifter& shifter_;
  Eigen::MatrixXf centers_;
  MeanShiftResult& result_;
  std::vector<int32_t> live_;
};

int32_t NearestPoint(const Eigen::MatrixXf& points,
                     const Eigen::VectorXf& position) {
  Eigen::Index nearest = 0;
  (points.colwise() - position).colwise().squaredNorm().minCoeff(&nearest);
  return static_cast<int32_t>(nearest);
}

}  // namespace

absl::StatusOr<MeanShiftResult> RunMeanShift(const Eigen::MatrixXf& points,
                                             const Eigen::VectorXf& masses,
                                             const MeanShiftOptions& options,
                                             const StopToken& stop) {
  const Shifter shifter(points, masses);
  const auto min_window = static_cast<float>(options.min_window);
  Eigen::MatrixXf positions = points;
  Eigen::VectorXf densities;
  shifter.Shift(min_window, kShiftSteps, positions, densities);
  ARGMESH_RETURN_IF_ERROR(stop.Check());

  Fused fused = FuseConverged(positions, densities, min_window);
  MeanShiftResult result;
  result.mode_of_point = std::move(fused.owner_of_point);
  Eigen::MatrixXf centers(
      points.rows(), static_cast<Eigen::Index>(fused.representatives.size()));
  for (size_t m = 0; m < fused.representatives.size(); ++m) {
    const int32_t p = fused.representatives[m];
    centers.col(static_cast<Eigen::Index>(m)) = positions.col(p);
    ShiftedMode mode;
    mode.nearest_point = NearestPoint(points, positions.col(p));
    mode.window = min_window;
    mode.density = densities[p];
    result.modes.push_back(mode);
  }
  WindowLadder ladder(shifter, std::move(centers), result);
  constexpr double kRounding = 1.001;  // the last rung may be w_MAX itself
  double window = options.min_window * options.window_growth;
  while (window <= options.max_window * kRounding) {
    ladder.Climb(static_cast<float>(window));
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    window *= options.window_growth;
  }
  return result;
}

}  // namespace argmesh
