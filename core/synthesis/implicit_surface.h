// A solid composed of primitives: smooth unions and smooth cuts in the order
// of the calls, each primitive belonging to a named part.
//
//   ImplicitSurface surface;
//   surface.BeginPart("body");
//   surface.Add(MakeLathe(pose, outline, 0.01));
//   surface.BeginPart("handle");
//   surface.Add(MakeTorus(pose, 0.2, 0.05), 0.04);
//   surface.Cut(MakeBox(pose, half, 0.01));
//
// Blending uses the quadratic smooth minimum: surfaces closer than `blend`
// melt into each other.
// Cost     Distance O(primitives considered). Const calls are thread-safe.
#ifndef ARGMESH_CORE_SYNTHESIS_IMPLICIT_SURFACE_H_
#define ARGMESH_CORE_SYNTHESIS_IMPLICIT_SURFACE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/synthesis/primitive.h"

namespace argmesh {

class ImplicitSurface {
 public:
  // Primitives added from now on belong to the part of this name; a name used
  // before continues that part.
  void BeginPart(std::string_view name);
  void Add(Primitive primitive, double blend = 0);
  // Primitives that first unite sharply and then blend as one, so that the
  // joints of a tube do not swell.
  void AddUnion(std::vector<Primitive> primitives, double blend = 0);
  // Takes the primitive's solid away.
  void Cut(Primitive primitive, double blend = 0);

  int num_primitives() const { return static_cast<int>(terms_.size()); }
  const std::vector<std::string>& part_names() const { return part_names_; }
  // Of the united primitives.
  Eigen::AlignedBox3d Bounds() const;

  // Negative inside. `terms` are ascending primitive numbers to consider.
  double Distance(const Eigen::Vector3d& p,
                  std::span<const int32_t> terms) const;
  // Of the terms those that can shape the surface within `radius` of p.
  // Sets `distance` to the distance at p.
  std::vector<int32_t> TermsNear(const Eigen::Vector3d& p, double radius,
                                 std::span<const int32_t> terms,
                                 double* distance) const;
  // The part of the united primitive nearest to p; -1 without terms.
  int32_t PartAt(const Eigen::Vector3d& p,
                 std::span<const int32_t> terms) const;
  // 0, 1, ... num_primitives() - 1.
  std::vector<int32_t> AllTerms() const;

 private:
  struct Term {
    Primitive primitive;
    double blend = 0;
    bool cut = false;
    int32_t part = 0;
    int32_t group = 0;  // terms of one union are neighbours
  };
  void Append(Primitive primitive, double blend, bool cut);
  static double Combine(const Term& term, double so_far, double own);

  std::vector<Term> terms_;
  std::vector<std::string> part_names_;
  int32_t current_part_ = -1;
  int32_t num_groups_ = 0;
  double max_blend_ = 0;
};

}  // namespace argmesh

#endif  // ARGMESH_CORE_SYNTHESIS_IMPLICIT_SURFACE_H_
