#include "tests/support/random_graph.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/random.h"

namespace argmesh {
namespace {

float Draw(Random& random, double low, double high) {
  return static_cast<float>(random.Uniform(low, high));
}

void Normalize(std::span<float> bins) {
  float sum = 0;
  for (const float bin : bins) sum += bin;
  for (float& bin : bins) bin /= sum;
}

void FillHistogram(Random& random, std::span<float> bins) {
  for (float& bin : bins) bin = Draw(random, 0.001, 1);
  Normalize(bins);
}

template <typename Visit>
void VisitHistograms(NodeHistograms& h, const Visit& visit) {
  visit(std::span<float>(h.shape_diameter));
  visit(std::span<float>(h.average_geodesic));
  visit(std::span<float>(h.shape_index));
  visit(std::span<float>(h.curvedness));
  visit(std::span<float>(h.internal_distance));
  visit(std::span<float>(h.outer_distance));
  visit(std::span<float>(h.relative_diameter));
}

ArgNode DrawNode(Random& random) {
  ArgNode node;
  node.tuple = {Draw(random, 0, 1),   Draw(random, 0, 3),
                Draw(random, -3, 3),  Draw(random, 0, 2),
                Draw(random, -2, 2),  Draw(random, 0, 0.3),
                Draw(random, 0, 0.8), 0};
  VisitHistograms(node.histograms, [&random](std::span<float> bins) {
    FillHistogram(random, bins);
  });
  for (float& x : node.wave_kernel) x = Draw(random, -3, 1);
  for (float& x : node.center) x = Draw(random, -0.5, 0.5);
  node.area = Draw(random, 0.1, 1);
  return node;
}

void NormalizeAreas(ArgLevel& level) {
  float sum = 0;
  for (const ArgNode& node : level.nodes) sum += node.area;
  for (ArgNode& node : level.nodes) {
    node.area = std::min(1.0F, node.area / sum);
    node.tuple.log2_relative_area = std::log2(node.area);
  }
}

ArgLevel DrawLevel(Random& random, int num_nodes, int num_parents) {
  ArgLevel level;
  for (int i = 0; i < num_nodes; ++i) {
    level.nodes.push_back(DrawNode(random));
    level.nodes.back().parent =
        num_parents == 0 ? -1 : std::min(i, num_parents - 1);
  }
  NormalizeAreas(level);
  for (int i = 0; i < num_nodes; ++i) {
    for (int j = i + 1; j < num_nodes; ++j) {
      level.distances.push_back(Draw(random, 0.1, 1.5));
      if (random.Uniform() < 0.3) {
        level.edges.push_back(
            {i, j, level.distances.back(), Draw(random, 0, 0.5)});
      }
    }
  }
  return level;
}

}  // namespace

ShapeGraph MakeRandomGraph(uint64_t seed, const RandomGraphOptions& options) {
  Random random(seed);
  ShapeGraph graph;
  int num_parents = 0;
  for (size_t l = 0; l < options.level_nodes.size(); ++l) {
    graph.levels.push_back(
        DrawLevel(random, options.level_nodes[l], num_parents));
    num_parents = options.level_nodes[l];
    ArgLevel& level = graph.levels.back();
    if (l + 1 == options.level_nodes.size()) {
      level.count = 16;
    } else {
      level.threshold = 1.6 + 0.4 * static_cast<double>(l);
    }
  }
  graph.uniform = DrawLevel(random, options.uniform_nodes, num_parents);
  for (int i = 0; i < options.modes && num_parents > 0; ++i) {
    ArgMode mode;
    for (float& x : mode.position) x = Draw(random, -0.5, 0.5);
    mode.window = Draw(random, 0.03, 0.07);
    mode.repeatability = static_cast<int32_t>(1 + random.Below(6));
    mode.density = Draw(random, 0, 1);
    mode.offset = Draw(random, 0, 1);
    mode.node =
        static_cast<int32_t>(random.Below(static_cast<uint64_t>(num_parents)));
    graph.modes.push_back(mode);
  }
  graph.centroid = {random.Uniform(-9, 9), random.Uniform(-9, 9),
                    random.Uniform(-9, 9)};
  graph.scale = random.Uniform(0.01, 100);
  graph.num_components = static_cast<int32_t>(1 + random.Below(3));
  graph.decomposition = static_cast<uint32_t>(random.Below(4));
  return graph;
}

namespace {

void PerturbLevel(ArgLevel& level, float amount, Random& random) {
  const auto move = [&random, amount](float& x) {
    x += Draw(random, -1, 1) * amount;
  };
  for (ArgNode& node : level.nodes) {
    move(node.tuple.gauss_deviation);
    move(node.tuple.gauss_mean);
    move(node.tuple.mean_deviation);
    move(node.tuple.mean_mean);
    for (float& x : node.wave_kernel) move(x);
    VisitHistograms(node.histograms, [&move](std::span<float> bins) {
      for (float& bin : bins) {
        move(bin);
        bin = std::max(bin, 0.001F);
      }
      Normalize(bins);
    });
  }
  for (float& distance : level.distances) {
    move(distance);
    distance = std::max(distance, 0.001F);
  }
}

}  // namespace

ShapeGraph PerturbGraph(const ShapeGraph& graph, float amount, uint64_t seed) {
  Random random(seed);
  ShapeGraph moved = graph;
  for (ArgLevel& level : moved.levels) PerturbLevel(level, amount, random);
  PerturbLevel(moved.uniform, amount, random);
  return moved;
}

ArgLevel CutLevel(const ArgLevel& level, int num_nodes) {
  ArgLevel cut;
  cut.threshold = level.threshold;
  cut.count = level.count;
  for (int i = 0; i < num_nodes; ++i) {
    cut.nodes.push_back(level.nodes[static_cast<size_t>(i)]);
    for (int j = i + 1; j < num_nodes; ++j) {
      cut.distances.push_back(level.Distance(i, j));
    }
  }
  for (const ArgEdge& edge : level.edges) {
    if (edge.b < num_nodes) cut.edges.push_back(edge);
  }
  NormalizeAreas(cut);
  return cut;
}

FaceLabels MakeRandomFaceLabels(uint64_t seed, int num_faces) {
  Random random(seed);
  FaceLabels labels;
  for (int f = 0; f < num_faces; ++f) {
    labels.component.push_back(
        static_cast<int16_t>(static_cast<int>(random.Below(17)) - 1));
    labels.uniform.push_back(
        static_cast<int16_t>(static_cast<int>(random.Below(33)) - 1));
  }
  return labels;
}

}  // namespace argmesh
