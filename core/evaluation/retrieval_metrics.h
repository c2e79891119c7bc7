// How good a ranking is when every item belongs to a class: the measures of
// the shape retrieval literature. Each is 0 .. 1, larger is better.
//
// A query's ranking holds the other items, best first; an item of the query's
// class is relevant. C is the number of relevant items.
//   nearest_neighbor   1 when the first item is relevant
//   first_tier         relevant share of the C relevant within the first C
//   second_tier        the same within the first 2 C
//   e_measure          2 P R / (P + R), P and R of the first 32
//   dcg                G_1 + sum over i >= 2 of G_i / log2(i), over the value
//                      of the perfect ranking; G_i = 1 when item i is relevant
//   average_precision  mean over relevant items of the precision at their rank
//
// Source   Shilane, Min, Kazhdan, Funkhouser, "The Princeton Shape Benchmark",
//          SMI 2004; average precision as in TREC.
// Fails    kInvalidArgument  sizes that do not fit, a score that is no number,
//                            an item twice or out of range
// Cost     O(n log n) for each query. Thread-safe.
#ifndef ARGMESH_CORE_EVALUATION_RETRIEVAL_METRICS_H_
#define ARGMESH_CORE_EVALUATION_RETRIEVAL_METRICS_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace argmesh {

struct RetrievalMetrics {
  double nearest_neighbor = 0;
  double first_tier = 0;
  double second_tier = 0;
  double e_measure = 0;
  double dcg = 0;
  double average_precision = 0;
};

// Precision at recall 0.05, 0.10 .. 1.00, interpolated: the best precision at
// that recall or above.
inline constexpr int kRecallSteps = 20;
using PrecisionRecall = std::array<double, kRecallSteps>;

// Items retrieved for the E-measure.
inline constexpr int kEMeasureDepth = 32;

struct QueryEvaluation {
  int32_t query = 0;
  RetrievalMetrics metrics;
  PrecisionRecall precision_recall{};
};

struct ClassEvaluation {
  std::string name;
  int num_items = 0;
  int num_queries = 0;  // 0 for a class of one item: nothing is relevant
  RetrievalMetrics mean;
};

struct RetrievalEvaluation {
  std::vector<QueryEvaluation> queries;  // without those nothing is relevant to
  RetrievalMetrics mean;                 // over queries (micro average)
  PrecisionRecall precision_recall{};    // mean over queries
  std::vector<ClassEvaluation> classes;  // sorted by name
};

// One ranking: `relevant[i]` tells whether item i is; `num_relevant` >= 1
// counts the relevant ones in the collection, ranked or not.
RetrievalMetrics EvaluateRanking(std::span<const uint8_t> relevant,
                                 int num_relevant);
PrecisionRecall EvaluatePrecisionRecall(std::span<const uint8_t> relevant,
                                        int num_relevant);

// Every item queries the collection and is left out of its own ranking.
// `scores(q, i)` is how alike q and i are; equal scores rank by index.
absl::StatusOr<RetrievalEvaluation> EvaluateScores(
    const Eigen::MatrixXd& scores, std::span<const std::string> classes);

// `ranked[q]` lists item indices, best first; the query itself is skipped when
// it is there; items missing count as not retrieved.
absl::StatusOr<RetrievalEvaluation> EvaluateRankedLists(
    std::span<const std::vector<int32_t>> ranked,
    std::span<const std::string> classes);

}  // namespace argmesh

#endif  // ARGMESH_CORE_EVALUATION_RETRIEVAL_METRICS_H_
