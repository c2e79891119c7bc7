// Retrieval, robustness and time of signatures on a labelled folder, without a
// server: for choosing parameters. Published figures come from the service.
//
//   signature_accuracy FOLDER                  leave one out
//   signature_accuracy FOLDER --graph          fused with the graph's score
//   signature_accuracy FOLDER --queries CHANGED
//       queries of make_variants against FOLDER, whose own copies are left out
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "core/base/status_macros.h"
#include "core/evaluation/retrieval_metrics.h"
#include "core/graph/compute_graph.h"
#include "core/matching/match.h"
#include "core/mesh/mesh_repair.h"
#include "core/signature/compact_basis.h"
#include "core/signature/rerank.h"
#include "core/signature/signature_similarity.h"
#include "tests/benchmark/labelled_collection.h"

namespace argmesh {
namespace {

struct Options {
  std::string folder;
  std::string queries;
  bool graph = false;
  bool rerank = false;
  bool classes = false;
  int threads = 2;
};

struct Item {
  LabelledMesh mesh;
  ShapeSignature signature;
  SignatureTimes times;
  std::optional<ShapeGraph> graph;
};

absl::StatusOr<Item> ComputeItem(const std::filesystem::path& folder,
                                 const LabelledMesh& mesh, bool graph) {
  ARGMESH_ASSIGN_OR_RETURN(const TriangleMesh triangles,
                           ReadMesh(folder / mesh.path));
  ARGMESH_ASSIGN_OR_RETURN(const RepairedMesh repaired, RepairMesh(triangles));
  Item item;
  item.mesh = mesh;
  ARGMESH_ASSIGN_OR_RETURN(
      item.signature,
      ComputeShapeSignature(repaired.mesh, {}, {}, &item.times));
  if (graph) {
    ARGMESH_ASSIGN_OR_RETURN(ComputedGraph computed,
                             ComputeShapeGraph(triangles));
    item.graph = std::move(computed.graph);
  }
  return item;
}

absl::StatusOr<std::vector<Item>> ComputeItems(
    const std::filesystem::path& folder, const Options& options) {
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<LabelledMesh> meshes,
                           ReadLabels(folder));
  std::vector<absl::StatusOr<Item>> computed(meshes.size(),
                                             absl::UnknownError("not done"));
  ParallelFor(meshes.size(), options.threads, [&](size_t i) {
    computed[i] = ComputeItem(folder, meshes[i], options.graph);
  });
  std::vector<Item> items;
  for (size_t i = 0; i < computed.size(); ++i) {
    if (computed[i].ok()) {
      items.push_back(std::move(*computed[i]));
    } else {
      std::printf("%s: %s\n", meshes[i].path.c_str(),
                  computed[i].status().ToString().c_str());
    }
  }
  if (items.empty()) return absl::NotFoundError("no meshes");
  return items;
}

void PrintTimes(const std::vector<Item>& items) {
  std::vector<double> stages[4];
  for (const Item& item : items) {
    const absl::Duration all[] = {item.times.surface, item.times.points,
                                  item.times.views};
    double sum = 0;
    for (size_t s = 0; s < 3; ++s) {
      stages[s].push_back(absl::ToDoubleSeconds(all[s]));
      sum += stages[s].back();
    }
    stages[3].push_back(sum);
  }
  const char* names[] = {"surface", "points", "views", "signature"};
  for (size_t s = 0; s < 4; ++s) {
    std::sort(stages[s].begin(), stages[s].end());
    double sum = 0;
    for (const double seconds : stages[s]) sum += seconds;
    const size_t n = stages[s].size();
    std::printf("%-10s mean %.3f  median %.3f  p95 %.3f  max %.3f s\n",
                names[s], sum / static_cast<double>(n), stages[s][n / 2],
                stages[s][n * 95 / 100], stages[s].back());
  }
}

std::vector<std::string> LabelsOf(const std::vector<Item>& items) {
  std::vector<std::string> labels;
  for (const Item& item : items) labels.push_back(item.mesh.label);
  return labels;
}

template <typename Score>
Eigen::MatrixXd ScoreAll(const std::vector<Item>& rows,
                         const std::vector<Item>& columns, int threads,
                         Score&& score) {
  Eigen::MatrixXd scores(static_cast<Eigen::Index>(rows.size()),
                         static_cast<Eigen::Index>(columns.size()));
  ParallelFor(rows.size(), threads, [&](size_t i) {
    for (size_t j = 0; j < columns.size(); ++j) {
      scores(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          score(i, j);
    }
  });
  return scores;
}

void PrintMetrics(const std::string& name, const RetrievalMetrics& m) {
  std::printf("%-24s NN %.3f  FT %.3f  ST %.3f  E %.3f  DCG %.3f\n",
              name.c_str(), m.nearest_neighbor, m.first_tier, m.second_tier,
              m.e_measure, m.dcg);
}

RetrievalMetrics MeanOf(const RetrievalEvaluation& evaluation, int parity) {
  RetrievalMetrics mean;
  double count = 0;
  for (const QueryEvaluation& query : evaluation.queries) {
    if (parity >= 0 && query.query % 2 != parity) continue;
    mean.nearest_neighbor += query.metrics.nearest_neighbor;
    mean.first_tier += query.metrics.first_tier;
    mean.second_tier += query.metrics.second_tier;
    mean.e_measure += query.metrics.e_measure;
    mean.dcg += query.metrics.dcg;
    ++count;
  }
  for (double* value : {&mean.nearest_neighbor, &mean.first_tier,
                        &mean.second_tier, &mean.e_measure, &mean.dcg}) {
    *value /= count;
  }
  return mean;
}

absl::Status PrintRetrieval(const std::string& name,
                            const Eigen::MatrixXd& scores,
                            const std::vector<Item>& items, bool classes) {
  ARGMESH_ASSIGN_OR_RETURN(const RetrievalEvaluation evaluation,
                           EvaluateScores(scores, LabelsOf(items)));
  if (classes) {
    for (const ClassEvaluation& c : evaluation.classes) {
      PrintMetrics("  " + c.name, c.mean);
    }
  }
  PrintMetrics(name, evaluation.mean);
  return absl::OkStatus();
}

// Every item's short list is the whole collection.
absl::StatusOr<Eigen::MatrixXd> RerankAll(const Eigen::MatrixXd& scores) {
  const Eigen::Index n = scores.rows();
  Eigen::MatrixXd reranked(n, n);
  for (Eigen::Index q = 0; q < n; ++q) {
    std::vector<Eigen::Index> order{q};
    for (Eigen::Index i = 0; i < n; ++i) {
      if (i != q) order.push_back(i);
    }
    ARGMESH_ASSIGN_OR_RETURN(const Eigen::VectorXd list,
                             RerankShortList(scores(order, order)));
    reranked(q, q) = 1;
    for (size_t i = 1; i < order.size(); ++i) {
      reranked(q, order[i]) = list[static_cast<Eigen::Index>(i) - 1];
    }
  }
  return reranked;
}

absl::Status PrintReranked(const std::string& name,
                           const Eigen::MatrixXd& scores,
                           const std::vector<Item>& items) {
  ARGMESH_ASSIGN_OR_RETURN(const Eigen::MatrixXd reranked, RerankAll(scores));
  return PrintRetrieval(name + ", re-ranked", reranked, items, false);
}

// The weight of the signature that has the best first tier on odd-numbered
// queries (the 1st, 3rd ..), reported on the even-numbered ones.
absl::Status PrintFusion(const Eigen::MatrixXd& signature,
                         const Eigen::MatrixXd& graph,
                         const std::vector<Item>& items, bool rerank) {
  const std::vector<std::string> labels = LabelsOf(items);
  double best_weight = 0;
  double best = -1;
  for (int step = 0; step <= 20; ++step) {
    const double weight = step / 20.0;
    ARGMESH_ASSIGN_OR_RETURN(
        const RetrievalEvaluation evaluation,
        EvaluateScores(weight * signature + (1 - weight) * graph, labels));
    const double tier = MeanOf(evaluation, 0).first_tier;
    if (tier <= best) continue;
    best = tier;
    best_weight = weight;
  }
  const Eigen::MatrixXd fused =
      best_weight * signature + (1 - best_weight) * graph;
  ARGMESH_ASSIGN_OR_RETURN(const RetrievalEvaluation evaluation,
                           EvaluateScores(fused, labels));
  std::printf("weight of the signature %.2f, chosen on odd queries\n",
              best_weight);
  PrintMetrics("fused, odd queries", MeanOf(evaluation, 0));
  PrintMetrics("fused, even queries", MeanOf(evaluation, 1));
  PrintMetrics("fused", evaluation.mean);
  return rerank ? PrintReranked("fused", fused, items) : absl::OkStatus();
}

std::vector<MatchableGraph> GraphsOf(const std::vector<Item>& items) {
  std::vector<MatchableGraph> graphs;
  for (const Item& item : items) graphs.emplace_back(*item.graph);
  return graphs;
}

double GraphScore(const MatchableGraph& a, const MatchableGraph& b) {
  MatchOptions options;
  options.correspondence = false;
  return MatchGlobal(a, b, options).score;
}

absl::Status PrintCompact(const std::vector<Item>& items, int threads) {
  std::vector<const ShapeSignature*> signatures;
  for (const Item& item : items) signatures.push_back(&item.signature);
  ARGMESH_ASSIGN_OR_RETURN(const CompactBasis basis,
                           FitCompactBasis(signatures));
  std::vector<CompactVector> vectors;
  for (const Item& item : items) {
    vectors.push_back(ProjectSignature(basis, item.signature));
  }
  const Eigen::MatrixXd scores =
      ScoreAll(items, items, threads, [&](size_t i, size_t j) {
        return CompactSimilarity(vectors[i], vectors[j]);
      });
  return PrintRetrieval("64 bytes", scores, items, false);
}

absl::Status EvaluateCollection(const std::vector<Item>& items,
                                const Options& options) {
  const auto by_part = [&](std::vector<float> ShapeSignature::*part) {
    return ScoreAll(items, items, options.threads, [&](size_t i, size_t j) {
      const std::vector<float>& a = items[i].signature.*part;
      const std::vector<float>& b = items[j].signature.*part;
      double dot = 0;
      for (size_t d = 0; d < a.size(); ++d) {
        dot += static_cast<double>(a[d]) * static_cast<double>(b[d]);
      }
      return dot;
    });
  };
  ARGMESH_RETURN_IF_ERROR(
      PrintRetrieval("point", by_part(&ShapeSignature::point), items, false));
  ARGMESH_RETURN_IF_ERROR(
      PrintRetrieval("view", by_part(&ShapeSignature::view), items, false));
  const Eigen::MatrixXd scores =
      ScoreAll(items, items, options.threads, [&](size_t i, size_t j) {
        return SignatureSimilarity(items[i].signature, items[j].signature);
      });
  ARGMESH_RETURN_IF_ERROR(
      PrintRetrieval("signature", scores, items, options.classes));
  ARGMESH_RETURN_IF_ERROR(PrintCompact(items, options.threads));
  if (options.rerank) {
    ARGMESH_RETURN_IF_ERROR(PrintReranked("signature", scores, items));
  }
  if (!options.graph) return absl::OkStatus();
  const std::vector<MatchableGraph> graphs = GraphsOf(items);
  const Eigen::MatrixXd graph_scores = ScoreAll(
      items, items, options.threads,
      [&](size_t i, size_t j) { return GraphScore(graphs[i], graphs[j]); });
  ARGMESH_RETURN_IF_ERROR(PrintRetrieval("graph", graph_scores, items, false));
  return PrintFusion(scores, graph_scores, items, options.rerank);
}

// The row of `items` that a query was made from.
std::optional<size_t> FindSource(const std::vector<Item>& items,
                                 const std::string& path) {
  for (size_t i = 0; i < items.size(); ++i) {
    if (items[i].mesh.path == path) return i;
  }
  return std::nullopt;
}

absl::Status EvaluateQueries(const std::vector<Item>& items,
                             const Options& options) {
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<Item> queries,
                           ComputeItems(options.queries, options));
  const std::vector<std::string> labels = LabelsOf(items);
  std::vector<double> own;
  int same = 0, mirrored = 0;
  double own_rank = 0;
  RetrievalMetrics mean;
  for (const Item& query : queries) {
    const std::optional<size_t> source = FindSource(items, query.mesh.path);
    if (!source) continue;
    std::vector<std::pair<double, size_t>> ranking;
    for (size_t i = 0; i < items.size(); ++i) {
      ranking.emplace_back(
          -SignatureSimilarity(query.signature, items[i].signature), i);
    }
    own.push_back(-ranking[*source].first);
    switch (CompareHandedness(query.signature, items[*source].signature)) {
      case Handedness::kSame:
        ++same;
        break;
      case Handedness::kMirrored:
        ++mirrored;
        break;
      case Handedness::kUndecided:
        break;
    }
    std::sort(ranking.begin(), ranking.end());
    std::vector<uint8_t> relevant;
    int num_relevant = 0;
    for (size_t r = 0; r < ranking.size(); ++r) {
      const size_t i = ranking[r].second;
      if (i == *source) {
        own_rank += static_cast<double>(r + 1);
        continue;
      }
      relevant.push_back(labels[i] == query.mesh.label ? 1 : 0);
      num_relevant += relevant.back();
    }
    if (num_relevant == 0) continue;
    const RetrievalMetrics m = EvaluateRanking(relevant, num_relevant);
    mean.nearest_neighbor += m.nearest_neighbor;
    mean.first_tier += m.first_tier;
  }
  std::sort(own.begin(), own.end());
  const auto count = static_cast<double>(own.size());
  std::printf(
      "%zu queries: original at mean rank %.2f, similarity min %.3f median "
      "%.3f; class NN %.3f FT %.3f; same hand %d, mirrored %d\n",
      own.size(), own_rank / count, own.front(), own[own.size() / 2],
      mean.nearest_neighbor / count, mean.first_tier / count, same, mirrored);
  return absl::OkStatus();
}

absl::Status Run(const Options& options) {
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<Item> items,
                           ComputeItems(options.folder, options));
  PrintTimes(items);
  if (options.queries.empty()) return EvaluateCollection(items, options);
  return EvaluateQueries(items, options);
}

}  // namespace
}  // namespace argmesh

int main(int argc, char** argv) {
  argmesh::Options options;
  CLI::App app("Accuracy and time of signatures on a labelled folder");
  app.add_option("folder", options.folder, "Meshes with a labels.tsv")
      ->required();
  app.add_option("--queries", options.queries,
                 "Changed copies made by make_variants");
  app.add_flag("--graph", options.graph, "Fuse with the graph's score");
  app.add_flag("--rerank", options.rerank, "Re-rank as well");
  app.add_flag("--classes", options.classes, "Figures of every class");
  app.add_option("--threads", options.threads);
  CLI11_PARSE(app, argc, argv);
  const absl::Status status = argmesh::Run(options);
  if (!status.ok()) std::printf("%s\n", status.ToString().c_str());
  return status.ok() ? 0 : 1;
}
