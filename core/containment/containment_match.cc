#include "core/containment/containment_match.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "core/base/random.h"
#include "core/base/status_macros.h"
#include "core/containment/query_weights.h"
#include "core/containment/sampled_surface.h"
#include "core/containment/similarity.h"
#include "core/containment/window_pairs.h"

namespace argmesh {
namespace {

// Lengths in units of the query's size, sqrt(area).
constexpr float kCoarse = 0.06F;
constexpr float kFine = 0.02F;
constexpr double kVerifiedCover = 0.95;

constexpr size_t kShiftsTried = 3;
constexpr int kDrawsPerPlace = 10;
// Samples: a glance, a look, C and F.
constexpr size_t kGlance = 16;
constexpr size_t kLook = 64;
constexpr size_t kCoarseSamples = 256;
constexpr size_t kFineSamples = 600;
constexpr float kWorthRefining = 0.25F;  // a look that is refined at all
constexpr float kPlainHit = 0.92F;       // a look at which drawing stops
// Other places: how far their middles are apart, what a look must show of them,
// how often one of them and all of them are refined, and by how much F may be
// less than the first's.
constexpr float kApart = 0.3F;
constexpr float kPromising = 0.6F;
constexpr int kSpotTries = 3;
constexpr int kMaxTries = 40;
constexpr double kAsGoodCover = 0.05;

struct Effort {
  int places;  // looked at
  size_t refined;
  float worth_fine;  // C that is refined further
};
constexpr Effort kQuick{150, 3, 0.8F};
constexpr Effort kThorough{900, 8, 0.5F};

struct Placed {
  float cover = 0;
  float expected_scale = 1;
  Similarity place;
};

// The cover of a look at a place; 0 when a glance shows that it is far behind
// the best.
float LookAt(const Similarity& place, const LaidSurface& laid,
             const SampledSurface& target, float best) {
  constexpr float kTau = 1.3F * kCoarse;
  const float glance = Cover(place, laid, 0, kGlance, target, kTau);
  if (glance < 0.6F * best - 0.05F) return 0;
  const float rest = Cover(place, laid, kGlance, kLook, target, kTau);
  return (glance * kGlance + rest * (kLook - kGlance)) / float{kLook};
}

// Places drawn from each of `pairs` in turn, until one covers `enough`, best
// first; equal covers stay in the order they were drawn in.
std::vector<Placed> LookAtPlaces(std::span<const WindowPairs> pairs,
                                 const LaidSurface& laid,
                                 const SampledSurface& target, int count,
                                 float enough, Random& random) {
  std::vector<Placed> placed;
  float best = 0;
  for (int draw = 0; draw < count * kDrawsPerPlace &&
                     static_cast<int>(placed.size()) < count && best < enough;
       ++draw) {
    const WindowPairs& drawn = pairs[static_cast<size_t>(draw) % pairs.size()];
    const std::optional<Similarity> place = drawn.Draw(random);
    if (!place) continue;
    const float cover = LookAt(*place, laid, target, best);
    placed.push_back({cover, drawn.expected_scale(), *place});
    best = std::max(best, cover);
  }
  std::stable_sort(
      placed.begin(), placed.end(),
      [](const Placed& a, const Placed& b) { return a.cover > b.cover; });
  return placed;
}

constexpr float kStill = 0.001F;  // of the query's size: a step that ends it

struct Refinement {
  int steps;
  size_t samples;
  float tau;
  float shrink;
  float least_tau;
};
constexpr Refinement kCoarseRefinement{6, 160, 1.5F * kCoarse, 0.8F,
                                       0.5F * kCoarse};
constexpr Refinement kFineRefinement{6, 400, 0.5F * kCoarse, 0.7F,
                                     0.7F * kFine};

void Refine(const Refinement& refinement, const LaidSurface& laid,
            const SampledSurface& target, float expected_scale,
            Similarity& place) {
  float tau = refinement.tau;
  for (int i = 0; i < refinement.steps; ++i) {
    const float moved =
        AlignStep(laid, refinement.samples, target, tau, expected_scale, place);
    if (moved < kStill && tau <= refinement.least_tau) return;
    tau = std::max(refinement.least_tau, refinement.shrink * tau);
  }
}

// The best place of a query on a target and its covers at two finenesses.
struct Found {
  float coarse = 0;
  float fine = 0;
  Similarity place;
};

Found FindPlace(std::span<const WindowPairs> pairs, const LaidSurface& laid,
                const SampledSurface& target, const Effort& effort,
                Random& random) {
  std::vector<Placed> placed =
      LookAtPlaces(pairs, laid, target, effort.places, kPlainHit, random);
  placed.resize(std::min(placed.size(), effort.refined));
  Placed best;
  for (Placed& candidate : placed) {
    if (candidate.cover < kWorthRefining) break;
    Refine(kCoarseRefinement, laid, target, candidate.expected_scale,
           candidate.place);
    candidate.cover =
        Cover(candidate.place, laid, 0, kCoarseSamples, target, kCoarse);
    if (candidate.cover > best.cover) best = candidate;
  }
  Found found{best.cover, 0, best.place};
  if (best.cover < effort.worth_fine) return found;
  Similarity refined = best.place;
  Refine(kFineRefinement, laid, target, best.expected_scale, refined);
  for (const Similarity& place : {refined, best.place}) {
    const float fine = Cover(place, laid, 0, kFineSamples, target, kFine);
    if (fine > found.fine) {
      found.fine = fine;
      found.place = place;
    }
  }
  return found;
}

// From the frames of the windows to the meshes' own units.
Eigen::Matrix4d OwnUnits(const Similarity& place, const WindowFrame& query,
                         const WindowFrame& target) {
  Eigen::Matrix4d from = Eigen::Matrix4d::Identity();
  from.topLeftCorner<3, 3>() *= query.scale;
  from.topRightCorner<3, 1>() = -query.scale * query.origin;
  Eigen::Matrix4d between = Eigen::Matrix4d::Identity();
  between.topLeftCorner<3, 3>() = place.scale * place.rotation.cast<double>();
  between.topRightCorner<3, 1>() = place.shift.cast<double>();
  Eigen::Matrix4d to = Eigen::Matrix4d::Identity();
  to.topLeftCorner<3, 3>() /= target.scale;
  to.topRightCorner<3, 1>() = target.origin;
  return to * between * from;
}

// The pairs of the best shifts.
std::vector<WindowPairs> PairsOfShifts(const QueryWindows& query,
                                       const PreparedTarget& target,
                                       const ShapeVotes& votes,
                                       const VerifyOptions& options) {
  std::vector<WindowPairs> pairs;
  const std::array<int, kNumShifts> shifts = ShiftsByVotes(votes);
  for (const int shift : std::span(shifts).first<kShiftsTried>()) {
    WindowPairs of_shift(query, options.weights, options.flipped, target,
                         shift);
    if (!of_shift.empty()) pairs.push_back(std::move(of_shift));
  }
  return pairs;
}

// A place of its own on a target, in the target's frame.
struct Spot {
  Eigen::Vector3f middle;
  int tries = 0;
  float fine = 0;  // the best F of the tries
  Similarity place;
};

// The spot that a place is at, a new one when it is apart from all.
Spot& SpotOf(const Similarity& place, std::vector<Spot>& spots) {
  for (Spot& spot : spots) {
    if ((spot.middle - place.shift).norm() <= kApart * place.scale) return spot;
  }
  return spots.emplace_back(Spot{place.shift, 0, 0, place});
}

double Power8(double x) {
  const double x2 = x * x;
  return x2 * x2 * (x2 * x2);
}

}  // namespace

absl::StatusOr<ContainmentMatch> VerifyContainment(const QueryWindows& query,
                                                   const PreparedTarget& target,
                                                   const ShapeVotes& votes,
                                                   const VerifyOptions& options,
                                                   const StopToken& stop) {
  const LaidSurface laid = MakeLaidSurface(query, options.flipped);
  const Effort& effort = options.thorough ? kThorough : kQuick;
  Random random(options.seed);
  const std::vector<WindowPairs> pairs =
      PairsOfShifts(query, target, votes, options);
  ARGMESH_RETURN_IF_ERROR(stop.Check());
  Found found;
  if (!pairs.empty()) {
    found = FindPlace(pairs, laid, target.surface, effort, random);
  }
  ContainmentMatch match;
  match.votes = votes.score;
  match.coarse_cover = found.coarse;
  match.fine_cover = found.fine;
  match.score = match.votes + 2 * Power8(match.fine_cover);
  match.verified = match.fine_cover >= kVerifiedCover;
  match.flipped = options.flipped;
  if (found.coarse > 0) {
    match.transform = OwnUnits(found.place, query.frame, target.frame);
    match.query_coverage = std::min(
        1.0F,
        Cover(found.place, laid, 0, laid.points.size(), target.surface, kFine));
    match.target_coverage =
        std::min(1.0, match.query_coverage * found.place.scale *
                          static_cast<double>(found.place.scale));
  }
  return match;
}

absl::StatusOr<std::vector<Eigen::Matrix4d>> FindOtherPlaces(
    const QueryWindows& query, const PreparedTarget& target,
    const ShapeVotes& votes, const ContainmentMatch& match,
    const VerifyOptions& options, const StopToken& stop) {
  std::vector<Eigen::Matrix4d> others;
  const std::vector<WindowPairs> pairs =
      PairsOfShifts(query, target, votes, options);
  if (pairs.empty()) return others;
  ARGMESH_RETURN_IF_ERROR(stop.Check());
  const LaidSurface laid = MakeLaidSurface(query, options.flipped);
  Random random(options.seed + 2);
  const std::vector<Placed> placed = LookAtPlaces(
      pairs, laid, target.surface, kThorough.places, /*enough=*/2, random);
  // A query lies about the origin of its frame.
  const Eigen::Vector3d first =
      (match.transform * query.frame.origin.homogeneous()).head<3>();
  std::vector<Spot> spots(1);
  spots[0].middle =
      (target.frame.scale * (first - target.frame.origin)).cast<float>();
  spots[0].tries = kSpotTries;
  int tries = 0;
  for (const Placed& candidate : placed) {
    if (candidate.cover < kPromising || tries == kMaxTries) break;
    Spot& spot = SpotOf(candidate.place, spots);
    if (spot.tries == kSpotTries) continue;
    ARGMESH_RETURN_IF_ERROR(stop.Check());
    ++spot.tries;
    ++tries;
    Similarity place = candidate.place;
    Refine(kCoarseRefinement, laid, target.surface, candidate.expected_scale,
           place);
    Refine(kFineRefinement, laid, target.surface, candidate.expected_scale,
           place);
    const float fine =
        Cover(place, laid, 0, kFineSamples, target.surface, kFine);
    Spot& reached = SpotOf(place, spots);
    if (fine > reached.fine) {
      reached.fine = fine;
      reached.place = place;
    }
  }
  spots.erase(spots.begin());
  std::erase_if(spots, [&](const Spot& spot) {
    return spot.fine < match.fine_cover - kAsGoodCover;
  });
  std::stable_sort(
      spots.begin(), spots.end(),
      [](const Spot& a, const Spot& b) { return a.fine > b.fine; });
  spots.resize(std::min(spots.size(), kMaxOtherPlaces));
  others.reserve(spots.size());
  for (const Spot& spot : spots) {
    others.push_back(OwnUnits(spot.place, query.frame, target.frame));
  }
  return others;
}

}  // namespace argmesh
