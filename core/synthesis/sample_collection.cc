#include "core/synthesis/sample_collection.h"

#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "absl/strings/str_format.h"
#include "core/base/random.h"
#include "core/base/status_macros.h"
#include "core/synthesis/mesh_cut.h"
#include "core/synthesis/mesh_noise.h"
#include "core/synthesis/mesh_similarity.h"

namespace argmesh {
namespace {

absl::Status CheckOptions(const SampleCollectionOptions& options) {
  if (options.shapes_per_class < 1 || options.shapes_per_class > 10'000) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "shapes_per_class %d is outside 1 .. 10000", options.shapes_per_class));
  }
  for (const double share :
       {options.noisy_share, options.cut_share, options.moved_share}) {
    if (!(share >= 0 && share <= 1)) {
      return absl::InvalidArgumentError(
          absl::StrFormat("share %g is outside 0 .. 1", share));
    }
  }
  const double sum =
      options.noisy_share + options.cut_share + options.moved_share;
  if (sum > 1 + 1e-12) {
    return absl::InvalidArgumentError(
        absl::StrFormat("shares sum to %g, limit 1", sum));
  }
  if (!(options.noise >= 0 && options.noise <= 0.1)) {
    return absl::InvalidArgumentError(
        absl::StrFormat("noise %g is outside 0 .. 0.1", options.noise));
  }
  return absl::OkStatus();
}

SampleCondition ConditionOf(const SampleCollectionOptions& options,
                            int variant) {
  const int n = options.shapes_per_class;
  const auto count = [n](double share) {
    return static_cast<int>(std::lround(share * n));
  };
  int first = n - count(options.moved_share);
  if (variant >= first) return SampleCondition::kMoved;
  first -= count(options.cut_share);
  if (variant >= first) return SampleCondition::kCut;
  first -= count(options.noisy_share);
  if (variant >= first) return SampleCondition::kNoisy;
  return SampleCondition::kClean;
}

TriangleMesh Apply(SampleCondition condition, TriangleMesh mesh, double noise,
                   uint64_t seed) {
  switch (condition) {
    case SampleCondition::kClean:
      return mesh;
    case SampleCondition::kNoisy:
      return AddNoise(mesh, noise, seed);
    case SampleCondition::kCut:
      return CutHalf(mesh, static_cast<int>(Random(seed).Below(3)));
    case SampleCondition::kMoved:
      return RandomSimilarity(mesh, seed);
  }
  return mesh;
}

}  // namespace

int CountSampleItems(const SampleCollectionOptions& options) {
  return static_cast<int>(SampleClassNames().size()) * options.shapes_per_class;
}

absl::StatusOr<SampleItem> MakeSampleItem(
    const SampleCollectionOptions& options, int item) {
  ARGMESH_RETURN_IF_ERROR(CheckOptions(options));
  if (item < 0 || item >= CountSampleItems(options)) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "item %d is outside 0 .. %d", item, CountSampleItems(options) - 1));
  }
  const int variant = item % options.shapes_per_class;
  const std::string name(
      SampleClassNames()[static_cast<size_t>(item / options.shapes_per_class)]);
  const uint64_t seed =
      Random(options.seed).NextU64() + static_cast<uint64_t>(variant);
  ARGMESH_ASSIGN_OR_RETURN(SampleShape shape,
                           MakeSampleShape(name, seed, options.shape));
  const SampleCondition condition = ConditionOf(options, variant);
  return SampleItem{
      .relative_path = absl::StrFormat("%s/%s-%02d.off", name, name, variant),
      .class_name = name,
      .condition = condition,
      .mesh = Apply(condition, std::move(shape.mesh), options.noise,
                    seed ^ 0x5DEECE66DULL)};
}

absl::Status MakeSampleCollection(
    const SampleCollectionOptions& options,
    const std::function<absl::Status(SampleItem)>& visit) {
  ARGMESH_RETURN_IF_ERROR(CheckOptions(options));
  for (int item = 0; item < CountSampleItems(options); ++item) {
    ARGMESH_ASSIGN_OR_RETURN(SampleItem sample, MakeSampleItem(options, item));
    ARGMESH_RETURN_IF_ERROR(visit(std::move(sample)));
  }
  return absl::OkStatus();
}

}  // namespace argmesh
