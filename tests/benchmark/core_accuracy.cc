// Retrieval, segmentation and time of the core on a labelled folder, without a
// server: for choosing parameters. Published figures come from the service.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/evaluation/retrieval_metrics.h"
#include "core/evaluation/segmentation.h"
#include "core/geometry/area.h"
#include "core/graph/compute_graph.h"
#include "core/graph/graph_codec.h"
#include "core/matching/frozen_scales.h"
#include "core/matching/match.h"
#include "tests/benchmark/hand_made_parts.h"
#include "tests/benchmark/labelled_collection.h"

namespace argmesh {
namespace {

struct Options {
  std::string folder;
  std::string decomposition = "biharmonic";
  bool tuple = false;
  bool scales = false;
  int vertex_budget = 3000;
  int uniform_cells = 32;
  int threads = 2;
};

struct Item {
  ComputedGraph computed;
  size_t graph_bytes = 0;
  std::map<std::string, double> rand_error;  // by level
  std::map<std::string, int> components;
};

DecompositionKind KindOf(const std::string& name) {
  for (const auto kind :
       {DecompositionKind::kNormalCurvature, DecompositionKind::kVoronoi}) {
    if (DecompositionName(kind) == name) return kind;
  }
  return DecompositionKind::kBiharmonic;
}

void MeasureSegmentation(const TriangleMesh& mesh, const HandMadeParts& parts,
                         Item& item) {
  const std::vector<int32_t> reference =
      ConnectedParts(mesh, parts.part_of_face);
  const Eigen::VectorXd face_areas = ComputeFaceAreas(mesh);
  const std::vector<std::string> names = LevelNames(item.computed.graph);
  for (size_t level = 0; level < item.computed.graph.levels.size(); ++level) {
    const std::vector<int16_t> labels = LabelsAtLevel(
        item.computed.graph, item.computed.labels, static_cast<int>(level));
    std::vector<int32_t> found, expected;
    std::vector<double> areas;
    for (size_t f = 0; f < labels.size(); ++f) {
      if (labels[f] < 0 || reference[f] < 0) continue;
      found.push_back(labels[f]);
      expected.push_back(reference[f]);
      areas.push_back(face_areas[static_cast<Eigen::Index>(f)]);
    }
    const auto error = RandIndexError(found, expected, areas);
    if (!error.ok()) continue;
    item.rand_error[names[level]] = *error;
    item.components[names[level]] =
        item.computed.graph.levels[level].num_nodes();
  }
}

std::optional<Item> ComputeItem(const std::filesystem::path& path,
                                const Options& options) {
  const auto mesh = ReadMesh(path);
  if (!mesh.ok()) {
    std::printf("%s: %s\n", path.c_str(), mesh.status().ToString().c_str());
    return std::nullopt;
  }
  AbstractionOptions abstraction;
  abstraction.decomposition =
      DecompositionOptionsFor(KindOf(options.decomposition));
  abstraction.resample.vertex_budget = options.vertex_budget;
  abstraction.uniform_cells = options.uniform_cells;
  auto computed = ComputeShapeGraph(*mesh, abstraction);
  if (!computed.ok()) {
    std::printf("%s: %s\n", path.c_str(), computed.status().ToString().c_str());
    return std::nullopt;
  }
  Item item;
  item.computed = std::move(*computed);
  item.graph_bytes = SerializeShapeGraph(item.computed.graph).size();
  const auto parts = ReadHandMadeParts(path, mesh->num_faces());
  if (parts.ok()) MeasureSegmentation(*mesh, *parts, item);
  return item;
}

void PrintQuantiles(const char* name, std::vector<double> values) {
  std::sort(values.begin(), values.end());
  std::printf("%-14s median %.3f  p95 %.3f  max %.3f s\n", name,
              values[values.size() / 2], values[values.size() * 95 / 100],
              values.back());
}

void PrintTimes(const std::vector<Item>& items) {
  std::vector<double> stages[6];
  double bytes = 0;
  for (const Item& item : items) {
    const AbstractionTimes& times = item.computed.abstraction_times;
    const absl::Duration all[] = {times.repair, times.resample, times.features,
                                  times.decomposition,
                                  item.computed.attribute_time};
    absl::Duration sum;
    for (size_t s = 0; s < 5; ++s) {
      stages[s].push_back(absl::ToDoubleSeconds(all[s]));
      sum += all[s];
    }
    stages[5].push_back(absl::ToDoubleSeconds(sum));
    bytes += static_cast<double>(item.graph_bytes);
  }
  const char* names[] = {"repair",        "resample",   "features",
                         "decomposition", "attributes", "all"};
  for (size_t s = 0; s < 6; ++s) PrintQuantiles(names[s], stages[s]);
  std::printf("graph bytes    mean %.0f\n",
              bytes / static_cast<double>(items.size()));
}

void PrintSegmentation(const std::vector<Item>& items) {
  std::map<std::string, double> error;
  std::map<std::string, double> components;
  std::map<std::string, int> count;
  for (const Item& item : items) {
    for (const auto& [level, value] : item.rand_error) {
      error[level] += value;
      components[level] += item.components.at(level);
      ++count[level];
    }
  }
  for (const auto& [level, sum] : error) {
    std::printf("Rand error     %-10s %.4f  components %.1f  meshes %d\n",
                level.c_str(), sum / count[level],
                components[level] / count[level], count[level]);
  }
}

void PrintRetrieval(const std::vector<Item>& items,
                    const std::vector<std::string>& classes,
                    const Options& options) {
  std::vector<MatchableGraph> graphs;
  for (const Item& item : items) graphs.emplace_back(item.computed.graph);
  MatchOptions match;
  match.correspondence = false;
  if (options.tuple) match.attributes = AttributeSet::kTuple;
  const auto n = static_cast<Eigen::Index>(graphs.size());
  Eigen::MatrixXd scores(n, n);
  const absl::Time start = absl::Now();
  ParallelFor(graphs.size(), options.threads, [&](size_t i) {
    for (size_t j = 0; j < graphs.size(); ++j) {
      scores(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          MatchGlobal(graphs[i], graphs[j], match).score;
    }
  });
  const double seconds = absl::ToDoubleSeconds(absl::Now() - start);
  std::printf("pair           %.1f us a thread\n",
              1e6 * seconds * options.threads / static_cast<double>(n * n));
  const auto evaluation = EvaluateScores(scores, classes);
  if (!evaluation.ok()) {
    std::printf("%s\n", evaluation.status().ToString().c_str());
    return;
  }
  const auto print = [](const std::string& name, const RetrievalMetrics& m) {
    std::printf("%-14s NN %.3f  FT %.3f  ST %.3f  E %.3f  DCG %.3f\n",
                name.c_str(), m.nearest_neighbor, m.first_tier, m.second_tier,
                m.e_measure, m.dcg);
  };
  for (const ClassEvaluation& c : evaluation->classes) print(c.name, c.mean);
  print("all", evaluation->mean);
}

void PrintScales(const std::vector<Item>& items) {
  std::vector<ShapeGraph> graphs;
  for (size_t i = 0; i < items.size(); i += 2) {
    graphs.push_back(items[i].computed.graph);
  }
  const auto scales = ComputeFrozenScales(graphs);
  if (scales.ok()) std::printf("%s", FormatFrozenScales(*scales).c_str());
}

int Run(const Options& options) {
  const auto labels = ReadLabels(options.folder);
  if (!labels.ok()) {
    std::printf("%s\n", labels.status().ToString().c_str());
    return 1;
  }
  std::vector<std::optional<Item>> computed(labels->size());
  ParallelFor(labels->size(), options.threads, [&](size_t i) {
    computed[i] = ComputeItem(
        std::filesystem::path(options.folder) / (*labels)[i].path, options);
  });
  std::vector<Item> items;
  std::vector<std::string> classes;
  for (size_t i = 0; i < computed.size(); ++i) {
    if (!computed[i]) continue;
    items.push_back(std::move(*computed[i]));
    classes.push_back((*labels)[i].label);
  }
  std::printf("%zu of %zu meshes abstracted\n", items.size(), labels->size());
  if (items.empty()) return 1;
  PrintTimes(items);
  PrintSegmentation(items);
  PrintRetrieval(items, classes, options);
  if (options.scales) PrintScales(items);
  return 0;
}

}  // namespace
}  // namespace argmesh

int main(int argc, char** argv) {
  argmesh::Options options;
  CLI::App app("Accuracy and time of the core on a labelled folder");
  app.add_option("folder", options.folder, "Meshes with a labels.tsv")
      ->required();
  app.add_option("--decomposition", options.decomposition)
      ->check(CLI::IsMember({"biharmonic", "normal-curvature", "voronoi"}));
  app.add_flag("--tuple", options.tuple, "The paper's tuple alone");
  app.add_flag("--scales", options.scales,
               "Print scales measured on every second mesh");
  app.add_option("--vertex-budget", options.vertex_budget);
  app.add_option("--uniform-cells", options.uniform_cells);
  app.add_option("--threads", options.threads);
  CLI11_PARSE(app, argc, argv);
  return argmesh::Run(options);
}
