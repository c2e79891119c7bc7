// Seeded procedural meshes in named classes: real proportions, articulated
// poses, known parts and known genus. For demonstration, tests and load.
//
// Classes  airplane, ant, bird, chair, fish, gear, glasses, hand, human, key,
//          lamp, mug, octopus, pliers, quadruped, table, teapot, vase, wrench
// Output   one closed, oriented, connected 2-manifold a shape, upright on z,
//          about one unit long.
// Repeats  equal class, seed and options give bit-equal output.
// Poses in which the shape touches itself are drawn again.
// Fails    kNotFound         no class of this name
//          kInvalidArgument  an option outside its range
//          kInternal         no drawn pose had the class's genus
// Cost     10 to 60 ms a shape of 4,500 vertices. Thread-safe.
#ifndef ARGMESH_CORE_SYNTHESIS_SAMPLE_SHAPE_H_
#define ARGMESH_CORE_SYNTHESIS_SAMPLE_SHAPE_H_

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

struct SampleShapeOptions {
  // 1,000 .. 200,000; met within about a quarter, exceeded by up to three
  // times where fewer would tear thin parts.
  int target_vertices = 4500;
};

struct SampleShape {
  std::string class_name;
  TriangleMesh mesh;
  int genus = 0;
  std::vector<std::string> part_names;
  std::vector<int32_t> part_of_face;  // numbers into part_names
};

// Ascending.
std::vector<std::string_view> SampleClassNames();

absl::StatusOr<SampleShape> MakeSampleShape(
    std::string_view class_name, uint64_t variant_seed,
    const SampleShapeOptions& options = {});

}  // namespace argmesh

#endif  // ARGMESH_CORE_SYNTHESIS_SAMPLE_SHAPE_H_
