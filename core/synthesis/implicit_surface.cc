#include "core/synthesis/implicit_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace argmesh {
namespace {

constexpr double kFar = 1e30;

// Ellipsoid distances are not exact; this much slack keeps culling safe.
constexpr double kCullSlack = 1.2;

double SmoothMin(double a, double b, double blend) {
  if (blend <= 0) return std::min(a, b);
  const double h = std::max(blend - std::abs(a - b), 0.0) / blend;
  return std::min(a, b) - h * h * blend * 0.25;
}

}  // namespace

void ImplicitSurface::BeginPart(std::string_view name) {
  const auto found = std::find(part_names_.begin(), part_names_.end(), name);
  current_part_ = static_cast<int32_t>(found - part_names_.begin());
  if (found == part_names_.end()) part_names_.emplace_back(name);
}

void ImplicitSurface::Append(Primitive primitive, double blend, bool cut) {
  if (current_part_ < 0) BeginPart("body");
  max_blend_ = std::max(max_blend_, blend);
  terms_.push_back(
      {std::move(primitive), blend, cut, current_part_, num_groups_});
}

void ImplicitSurface::Add(Primitive primitive, double blend) {
  Append(std::move(primitive), blend, false);
  ++num_groups_;
}

void ImplicitSurface::AddUnion(std::vector<Primitive> primitives,
                               double blend) {
  for (Primitive& primitive : primitives) {
    Append(std::move(primitive), blend, false);
  }
  ++num_groups_;
}

void ImplicitSurface::Cut(Primitive primitive, double blend) {
  Append(std::move(primitive), blend, true);
  ++num_groups_;
}

Eigen::AlignedBox3d ImplicitSurface::Bounds() const {
  Eigen::AlignedBox3d box;
  for (const Term& term : terms_) {
    if (!term.cut) box.extend(term.primitive.Bounds());
  }
  return box;
}

double ImplicitSurface::Combine(const Term& term, double so_far, double own) {
  return term.cut ? -SmoothMin(-so_far, own, term.blend)
                  : SmoothMin(so_far, own, term.blend);
}

double ImplicitSurface::Distance(const Eigen::Vector3d& p,
                                 std::span<const int32_t> terms) const {
  double distance = kFar;
  double of_group = kFar;
  for (size_t i = 0; i < terms.size(); ++i) {
    const Term& term = terms_[static_cast<size_t>(terms[i])];
    of_group = std::min(of_group, term.primitive.Distance(p));
    if (i + 1 < terms.size() &&
        terms_[static_cast<size_t>(terms[i + 1])].group == term.group) {
      continue;
    }
    distance = Combine(term, distance, of_group);
    of_group = kFar;
  }
  return distance;
}

std::vector<int32_t> ImplicitSurface::TermsNear(const Eigen::Vector3d& p,
                                                double radius,
                                                std::span<const int32_t> terms,
                                                double* distance) const {
  std::vector<double> own(terms.size());
  double total = kFar;
  for (size_t i = 0; i < terms.size(); ++i) {
    const Term& term = terms_[static_cast<size_t>(terms[i])];
    own[i] = term.primitive.Distance(p);
    total = Combine(term, total, own[i]);
  }
  // Blending a union's members one by one errs toward nearer: fewer is culled.
  // Inside the ball the surface comes at most `radius` closer and a primitive
  // reaches at most `radius` nearer, so beyond this nothing can be felt.
  const double reach = kCullSlack * (2 * radius + max_blend_);
  std::vector<int32_t> near;
  for (size_t i = 0; i < terms.size(); ++i) {
    const bool cut = terms_[static_cast<size_t>(terms[i])].cut;
    if (own[i] <= reach + (cut ? 0.0 : std::max(total, 0.0))) {
      near.push_back(terms[i]);
    }
  }
  *distance = total;
  return near;
}

int32_t ImplicitSurface::PartAt(const Eigen::Vector3d& p,
                                std::span<const int32_t> terms) const {
  double best = std::numeric_limits<double>::infinity();
  int32_t part = -1;
  for (const int32_t t : terms) {
    const Term& term = terms_[static_cast<size_t>(t)];
    if (term.cut) continue;
    const double distance = term.primitive.Distance(p);
    if (distance < best) {
      best = distance;
      part = term.part;
    }
  }
  return part;
}

std::vector<int32_t> ImplicitSurface::AllTerms() const {
  std::vector<int32_t> terms(terms_.size());
  for (size_t i = 0; i < terms.size(); ++i) terms[i] = static_cast<int32_t>(i);
  return terms;
}

}  // namespace argmesh
