// What the graph score makes of changed copies: every n-th mesh of a labelled
// folder is changed and looked for among all, without a server.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "core/evaluation/retrieval_metrics.h"
#include "core/graph/compute_graph.h"
#include "core/matching/match.h"
#include "tests/benchmark/labelled_collection.h"
#include "tests/benchmark/mesh_changes.h"

namespace argmesh {
namespace {

struct Options {
  std::string folder;
  std::string change;  // one of them; empty: all
  int every = 2;
  int first = 0;
  int vertex_budget = 3000;
  int threads = 2;
};

constexpr double kSameShape = 0.98;

struct Gallery {
  std::vector<TriangleMesh> meshes;
  std::vector<std::string> classes;
  std::vector<MatchableGraph> graphs;
};

// What came of one changed copy.
struct Outcome {
  double score = 0;                // against its source
  double runner_up = 0;            // the best of the others
  RetrievalMetrics class_metrics;  // the source left out
};

std::optional<ShapeGraph> ComputeGraph(const TriangleMesh& mesh,
                                       const Options& options) {
  AbstractionOptions abstraction;
  abstraction.resample.vertex_budget = options.vertex_budget;
  auto computed = ComputeShapeGraph(mesh, abstraction);
  if (computed.ok()) return std::move(computed->graph);
  std::printf("%s\n", computed.status().ToString().c_str());
  return std::nullopt;
}

absl::StatusOr<Gallery> LoadGallery(const Options& options) {
  const auto labels = ReadLabels(options.folder);
  if (!labels.ok()) return labels.status();
  std::vector<std::optional<ShapeGraph>> graphs(labels->size());
  std::vector<TriangleMesh> meshes(labels->size());
  ParallelFor(labels->size(), options.threads, [&](size_t i) {
    auto mesh =
        ReadMesh(std::filesystem::path(options.folder) / (*labels)[i].path);
    if (!mesh.ok()) return;
    meshes[i] = std::move(*mesh);
    graphs[i] = ComputeGraph(meshes[i], options);
  });
  Gallery gallery;
  for (size_t i = 0; i < graphs.size(); ++i) {
    if (!graphs[i]) continue;
    gallery.meshes.push_back(std::move(meshes[i]));
    gallery.classes.push_back((*labels)[i].label);
    gallery.graphs.emplace_back(*graphs[i]);
  }
  return gallery;
}

Outcome Judge(const MatchableGraph& query, size_t source,
              const Gallery& gallery) {
  MatchOptions match;
  match.correspondence = false;
  std::vector<std::pair<double, size_t>> ranking;
  Outcome outcome;
  int class_mates = 0;
  for (size_t i = 0; i < gallery.graphs.size(); ++i) {
    const double score = MatchGlobal(query, gallery.graphs[i], match).score;
    if (i == source) {
      outcome.score = score;
      continue;
    }
    outcome.runner_up = std::max(outcome.runner_up, score);
    ranking.emplace_back(-score, i);
    if (gallery.classes[i] == gallery.classes[source]) ++class_mates;
  }
  std::sort(ranking.begin(), ranking.end());
  std::vector<uint8_t> relevant;
  for (const auto& [score, i] : ranking) {
    relevant.push_back(gallery.classes[i] == gallery.classes[source] ? 1 : 0);
  }
  if (class_mates > 0) {
    outcome.class_metrics = EvaluateRanking(relevant, class_mates);
  }
  return outcome;
}

void Print(const std::string& name, const std::vector<Outcome>& outcomes) {
  double score = 0, least = 1, same = 0, first = 0, nearest = 0, tier = 0;
  for (const Outcome& o : outcomes) {
    score += o.score;
    least = std::min(least, o.score);
    same += o.score >= kSameShape ? 1 : 0;
    first += o.score > o.runner_up ? 1 : 0;
    nearest += o.class_metrics.nearest_neighbor;
    tier += o.class_metrics.first_tier;
  }
  const auto n = static_cast<double>(outcomes.size());
  std::printf(
      "%-13s copies %zu  score mean %.3f least %.3f  >= %.2f: %.3f  source "
      "first %.3f  class NN %.3f FT %.3f\n",
      name.c_str(), outcomes.size(), score / n, least, kSameShape, same / n,
      first / n, nearest / n, tier / n);
  std::fflush(stdout);
}

void Measure(const MeshChange& change, const Gallery& gallery,
             const Options& options) {
  std::vector<size_t> sources;
  for (auto i = static_cast<size_t>(options.first); i < gallery.meshes.size();
       i += static_cast<size_t>(options.every)) {
    sources.push_back(i);
  }
  std::vector<std::optional<Outcome>> found(sources.size());
  ParallelFor(sources.size(), options.threads, [&](size_t k) {
    const size_t source = sources[k];
    const auto graph =
        ComputeGraph(change.apply(gallery.meshes[source], source + 1), options);
    if (graph) found[k] = Judge(MatchableGraph(*graph), source, gallery);
  });
  std::vector<Outcome> outcomes;
  for (const auto& outcome : found) {
    if (outcome) outcomes.push_back(*outcome);
  }
  if (!outcomes.empty()) Print(change.name, outcomes);
}

int Run(const Options& options) {
  const auto gallery = LoadGallery(options);
  if (!gallery.ok()) {
    std::printf("%s\n", gallery.status().ToString().c_str());
    return 1;
  }
  for (const MeshChange& change : WholeMeshChanges()) {
    if (options.change.empty() || options.change == change.name) {
      Measure(change, *gallery, options);
    }
  }
  return 0;
}

}  // namespace
}  // namespace argmesh

int main(int argc, char** argv) {
  argmesh::Options options;
  CLI::App app("Changed copies of a labelled folder looked for in it");
  app.add_option("folder", options.folder, "Meshes with a labels.tsv")
      ->required();
  app.add_option("--change", options.change, "Only the change of this name");
  app.add_option("--every", options.every, "Every n-th mesh is changed")
      ->check(CLI::PositiveNumber);
  app.add_option("--first", options.first, "The first that is, from 0")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--vertex-budget", options.vertex_budget);
  app.add_option("--threads", options.threads);
  CLI11_PARSE(app, argc, argv);
  return argmesh::Run(options);
}
