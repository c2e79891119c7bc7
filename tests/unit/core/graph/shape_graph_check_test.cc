#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/graph/shape_graph.h"
#include "tests/support/random_graph.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

TEST(CheckShapeGraph, AcceptsRandomGraphs) {
  for (uint64_t seed = 0; seed < 50; ++seed) {
    EXPECT_THAT(CheckShapeGraph(MakeRandomGraph(seed)), IsOk()) << seed;
  }
}

TEST(CheckShapeGraph, AcceptsAGraphOfNothing) {
  EXPECT_THAT(CheckShapeGraph(ShapeGraph()), IsOk());
}

struct Damage {
  const char* name;
  std::function<void(ShapeGraph&)> apply;
  const char* message;
};

const float kNan = std::numeric_limits<float>::quiet_NaN();
const float kInfinity = std::numeric_limits<float>::infinity();

std::vector<Damage> Damages() {
  return {
      {"zero area", [](auto& g) { g.levels[1].nodes[2].area = 0; },
       "level 1 node 2: area 0 outside (0, 1]"},
      {"area beyond the shape", [](auto& g) { g.uniform.nodes[0].area = 1.5F; },
       "uniform node 0: area 1.5"},
      {"area not a number", [](auto& g) { g.levels[0].nodes[0].area = kNan; },
       "area nan"},
      {"infinite tuple",
       [](auto& g) { g.levels[0].nodes[0].tuple.mean_mean = kInfinity; },
       "tuple value"},
      {"negative share",
       [](auto& g) { g.levels[0].nodes[0].histograms.shape_index[3] = -0.5F; },
       "histogram share"},
      {"share beyond one",
       [](auto& g) {
         g.levels[0].nodes[0].histograms.relative_diameter[0] = 2;
       },
       "histogram share"},
      {"wave kernel not a number",
       [](auto& g) { g.levels[0].nodes[0].wave_kernel[15] = kNan; },
       "wave kernel"},
      {"huge center", [](auto& g) { g.levels[0].nodes[0].center[2] = 1e30F; },
       "center"},
      {"parent at the first level",
       [](auto& g) { g.levels[0].nodes[0].parent = 0; },
       "level 0 node 0: parent 0 of 0"},
      {"no parent below", [](auto& g) { g.levels[2].nodes[0].parent = -1; },
       "level 2 node 0: parent -1 of 4"},
      {"parent beyond", [](auto& g) { g.levels[1].nodes[0].parent = 2; },
       "parent 2 of 2"},
      {"uniform parent beyond", [](auto& g) { g.uniform.nodes[3].parent = 10; },
       "uniform node 3: parent 10 of 10"},
      {"edge to itself",
       [](auto& g) {
         g.levels[1].edges = {{1, 1, 0, 0}};
       },
       "edge 1-1 of 4 nodes"},
      {"edge beyond",
       [](auto& g) {
         g.levels[1].edges = {{1, 4, 0, 0}};
       },
       "edge 1-4"},
      {"negative edge",
       [](auto& g) {
         g.levels[1].edges = {{-1, 2, 0, 0}};
       },
       "edge -1-2"},
      {"edges out of order",
       [](auto& g) {
         g.levels[1].edges = {{0, 2, 0, 0}, {0, 1, 0, 0}};
       },
       "edge 0-1 out of order"},
      {"edge twice",
       [](auto& g) {
         g.levels[1].edges = {{0, 2, 0, 0}, {0, 2, 0, 0}};
       },
       "edge 0-2 out of order"},
      {"negative border",
       [](auto& g) {
         g.levels[1].edges = {{0, 2, 0, -1}};
       },
       "length"},
      {"distance missing", [](auto& g) { g.levels[1].distances.pop_back(); },
       "5 distances for 6 pairs"},
      {"negative distance", [](auto& g) { g.levels[1].distances[0] = -1; },
       "distance outside"},
      {"level of nothing", [](auto& g) { g.levels[0] = ArgLevel(); },
       "level 0 has no node"},
      {"too many levels", [](auto& g) { g.levels.assign(65, g.levels[0]); },
       "65 levels"},
      {"too many nodes",
       [](auto& g) { g.levels[0].nodes.resize(4097, g.levels[0].nodes[0]); },
       "4097 nodes"},
      {"mode of no node", [](auto& g) { g.modes[1].node = 10; },
       "mode 1: node 10 of 10"},
      {"mode window not a number", [](auto& g) { g.modes[0].window = kNan; },
       "mode 0"},
      {"no scale", [](auto& g) { g.scale = 0; }, "scale 0"},
      {"infinite centroid",
       [](auto& g) { g.centroid[1] = static_cast<double>(kInfinity); },
       "centroid"},
      {"unknown decomposition", [](auto& g) { g.decomposition = 4; },
       "decomposition 4"},
  };
}

TEST(CheckShapeGraph, RefusesWhatIsNotWellFormed) {
  for (const Damage& damage : Damages()) {
    ShapeGraph graph = MakeRandomGraph(7);
    damage.apply(graph);
    EXPECT_THAT(
        CheckShapeGraph(graph),
        StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr(damage.message)))
        << damage.name;
  }
}

}  // namespace
}  // namespace argmesh
