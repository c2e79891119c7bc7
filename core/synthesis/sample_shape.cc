#include "core/synthesis/sample_shape.h"

#include <array>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "core/base/random.h"
#include "core/base/status_macros.h"
#include "core/synthesis/sample_models.h"
#include "core/synthesis/surface_polygons.h"

namespace argmesh {
namespace {

struct SampleClass {
  std::string_view name;
  SampleModel (*make)(Random&);
};

constexpr std::array<SampleClass, 19> kClasses = {{
    {"airplane", MakeAirplane},   {"ant", MakeAnt},
    {"bird", MakeBird},           {"chair", MakeChair},
    {"fish", MakeFish},           {"gear", MakeGear},
    {"glasses", MakeGlasses},     {"hand", MakeHand},
    {"human", MakeHuman},         {"key", MakeKey},
    {"lamp", MakeLamp},           {"mug", MakeMug},
    {"octopus", MakeOctopus},     {"pliers", MakePliers},
    {"quadruped", MakeQuadruped}, {"table", MakeTable},
    {"teapot", MakeTeapot},       {"vase", MakeVase},
    {"wrench", MakeWrench},
}};

// Different classes draw different numbers from equal seeds.
uint64_t SeedOf(std::string_view name, uint64_t variant_seed) {
  uint64_t hash = 0xCBF29CE484222325ULL;  // FNV-1a
  for (const char c : name) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3ULL;
  }
  return hash ^ Random(variant_seed).NextU64();
}

}  // namespace

std::vector<std::string_view> SampleClassNames() {
  std::vector<std::string_view> names;
  for (const SampleClass& sample : kClasses) names.push_back(sample.name);
  return names;
}

absl::StatusOr<SampleShape> MakeSampleShape(std::string_view class_name,
                                            uint64_t variant_seed,
                                            const SampleShapeOptions& options) {
  if (options.target_vertices < 1000 || options.target_vertices > 200'000) {
    return absl::InvalidArgumentError(
        absl::StrFormat("target_vertices %d is outside 1000 .. 200000",
                        options.target_vertices));
  }
  for (const SampleClass& sample : kClasses) {
    if (sample.name != class_name) continue;
    Random random(SeedOf(class_name, variant_seed));
    const SampleModel model = sample.make(random);
    ARGMESH_ASSIGN_OR_RETURN(
        PolygonizedSurface polygons,
        PolygonizeSurface(model.surface,
                          {.target_vertices = options.target_vertices}));
    return SampleShape{.class_name = std::string(class_name),
                       .mesh = std::move(polygons.mesh),
                       .genus = model.genus,
                       .part_names = model.surface.part_names(),
                       .part_of_face = std::move(polygons.part_of_face)};
  }
  return absl::NotFoundError(
      absl::StrFormat("no sample class \"%s\"", std::string(class_name)));
}

}  // namespace argmesh
