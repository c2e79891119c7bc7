// A whole collection of sample shapes, handed out one at a time.
//
// Of every class the first variants are whole and clean; the last ones are
// noisy, then cut in half, then turned, scaled and renumbered, each by its
// share.
// Repeats  equal options give bit-equal shapes, whatever was asked before.
// Fails    kInvalidArgument  an option outside its range
// Cost     10 to 90 ms a shape; memory for one shape.
#ifndef ARGMESH_CORE_SYNTHESIS_SAMPLE_COLLECTION_H_
#define ARGMESH_CORE_SYNTHESIS_SAMPLE_COLLECTION_H_

#include <cstdint>
#include <functional>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/mesh/triangle_mesh.h"
#include "core/synthesis/sample_shape.h"

namespace argmesh {

struct SampleCollectionOptions {
  int shapes_per_class = 6;  // 1 .. 10,000
  uint64_t seed = 1;
  double noisy_share = 0;  // of each class, 0 .. 1; rounded
  double cut_share = 0;    // of each class, 0 .. 1; rounded
  double moved_share = 0;  // of each class, 0 .. 1; the three sum to <= 1
  double noise = 0.004;    // of the diagonal, 0 .. 0.1
  SampleShapeOptions shape = {};
};

enum class SampleCondition { kClean, kNoisy, kCut, kMoved };

struct SampleItem {
  std::string relative_path;  // "mug/mug-03.off", numbers from 0
  std::string class_name;
  SampleCondition condition = SampleCondition::kClean;
  TriangleMesh mesh;
};

// Class by class; an error that `visit` returns ends the walk and is returned.
absl::Status MakeSampleCollection(
    const SampleCollectionOptions& options,
    const std::function<absl::Status(SampleItem)>& visit);

// The number of items MakeSampleCollection visits.
int CountSampleItems(const SampleCollectionOptions& options);

// Item 0 .. CountSampleItems - 1 alone.
absl::StatusOr<SampleItem> MakeSampleItem(
    const SampleCollectionOptions& options, int item);

}  // namespace argmesh

#endif  // ARGMESH_CORE_SYNTHESIS_SAMPLE_COLLECTION_H_
