#include "core/synthesis/sample_shape.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
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
  double detail = 1;  // thin walls need more vertices for their area
};

constexpr int kMaxPoses = 8;

constexpr std::array<SampleClass, 19> kClasses = {{
    {"airplane", MakeAirplane, 1.4},
    {"ant", MakeAnt},
    {"bird", MakeBird, 1.4},
    {"chair", MakeChair, 1.3},
    {"fish", MakeFish, 1.4},
    {"gear", MakeGear, 1.6},
    {"glasses", MakeGlasses},
    {"hand", MakeHand},
    {"human", MakeHuman},
    {"key", MakeKey},
    {"lamp", MakeLamp},
    {"mug", MakeMug, 1.5},
    {"octopus", MakeOctopus},
    {"pliers", MakePliers},
    {"quadruped", MakeQuadruped},
    {"table", MakeTable, 1.5},
    {"teapot", MakeTeapot},
    {"vase", MakeVase, 1.4},
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

int CountComponents(const TriangleMesh& mesh) {
  std::vector<int32_t> leader(static_cast<size_t>(mesh.num_vertices()));
  std::iota(leader.begin(), leader.end(), 0);
  const auto find = [&leader](int32_t v) {
    while (leader[static_cast<size_t>(v)] != v) {
      int32_t& up = leader[static_cast<size_t>(v)];
      up = leader[static_cast<size_t>(up)];
      v = up;
    }
    return v;
  };
  int components = mesh.num_vertices();
  for (int f = 0; f < mesh.num_faces(); ++f) {
    for (int k = 0; k < 2; ++k) {
      const int32_t a = find(mesh.F(f, k));
      const int32_t b = find(mesh.F(f, k + 1));
      if (a == b) continue;
      leader[static_cast<size_t>(b)] = a;
      --components;
    }
  }
  return components;
}

// Of a closed mesh, which has three edges for every two faces.
bool HasTopology(const TriangleMesh& mesh, int genus) {
  const int euler = mesh.num_vertices() - mesh.num_faces() / 2;
  return euler == 2 - 2 * genus && CountComponents(mesh) == 1;
}

// One pose, at a finer resolution when parts are torn; kNotFound when finer
// does not help because the pose touches itself.
absl::StatusOr<SampleShape> PolygonizePose(const SampleClass& sample,
                                           int target_vertices,
                                           Random& random) {
  const SampleModel model = sample.make(random);
  double vertices = sample.detail * target_vertices;
  for (int attempt = 0; attempt < 2; ++attempt, vertices *= 1.8) {
    ARGMESH_ASSIGN_OR_RETURN(
        PolygonizedSurface polygons,
        PolygonizeSurface(model.surface,
                          {.target_vertices =
                               std::min(static_cast<int>(vertices), 200'000)}));
    if (!HasTopology(polygons.mesh, model.genus)) continue;
    return SampleShape{.class_name = std::string(sample.name),
                       .mesh = std::move(polygons.mesh),
                       .genus = model.genus,
                       .part_names = model.surface.part_names(),
                       .part_of_face = std::move(polygons.part_of_face)};
  }
  return absl::NotFoundError("the pose touches itself");
}

}  // namespace

std::vector<std::string_view> SampleClassNames() {
  std::vector<std::string_view> names;
  names.reserve(std::size(kClasses));
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
    for (int pose = 0; pose < kMaxPoses; ++pose) {
      absl::StatusOr<SampleShape> shape =
          PolygonizePose(sample, options.target_vertices, random);
      if (shape.ok() || !absl::IsNotFound(shape.status())) return shape;
    }
    return absl::InternalError(
        absl::StrFormat("%s %d: no pose of the right genus in %d",
                        std::string(class_name), variant_seed, kMaxPoses));
  }
  return absl::NotFoundError(
      absl::StrFormat("no sample class \"%s\"", std::string(class_name)));
}

}  // namespace argmesh
