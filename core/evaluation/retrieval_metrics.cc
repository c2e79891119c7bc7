#include "core/evaluation/retrieval_metrics.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"

namespace argmesh {
namespace {

void Add(const RetrievalMetrics& by, RetrievalMetrics& sum) {
  sum.nearest_neighbor += by.nearest_neighbor;
  sum.first_tier += by.first_tier;
  sum.second_tier += by.second_tier;
  sum.e_measure += by.e_measure;
  sum.dcg += by.dcg;
  sum.average_precision += by.average_precision;
}

void DivideBy(int count, RetrievalMetrics& sum) {
  if (count == 0) return;
  for (double* value :
       {&sum.nearest_neighbor, &sum.first_tier, &sum.second_tier,
        &sum.e_measure, &sum.dcg, &sum.average_precision}) {
    *value /= count;
  }
}

absl::Status CheckList(size_t query, std::span<const int32_t> ranked,
                       size_t num_items) {
  std::vector<char> seen(num_items, 0);
  for (const int32_t item : ranked) {
    if (item < 0 || static_cast<size_t>(item) >= num_items) {
      return absl::InvalidArgumentError(
          absl::StrFormat("query %d: item %d of %d", query, item, num_items));
    }
    if (seen[static_cast<size_t>(item)] != 0) {
      return absl::InvalidArgumentError(
          absl::StrFormat("query %d: item %d twice", query, item));
    }
    seen[static_cast<size_t>(item)] = 1;
  }
  return absl::OkStatus();
}

// Collects the rankings of a collection, query after query.
class Evaluator {
 public:
  explicit Evaluator(std::span<const std::string> classes) : classes_(classes) {
    for (const std::string& name : classes) ++class_of_name_[name].num_items;
    for (auto& [name, entry] : class_of_name_) entry.name = name;
  }

  void Add(size_t query, std::span<const int32_t> ranked) {
    ClassEvaluation& own = class_of_name_[classes_[query]];
    const int num_relevant = own.num_items - 1;
    if (num_relevant == 0) return;
    std::vector<uint8_t> relevant;
    relevant.reserve(ranked.size());
    for (const int32_t item : ranked) {
      if (static_cast<size_t>(item) == query) continue;
      relevant.push_back(
          classes_[static_cast<size_t>(item)] == classes_[query] ? 1 : 0);
    }
    QueryEvaluation evaluation;
    evaluation.query = static_cast<int32_t>(query);
    evaluation.metrics = EvaluateRanking(relevant, num_relevant);
    evaluation.precision_recall =
        EvaluatePrecisionRecall(relevant, num_relevant);
    argmesh::Add(evaluation.metrics, own.mean);
    ++own.num_queries;
    argmesh::Add(evaluation.metrics, result_.mean);
    for (size_t s = 0; s < evaluation.precision_recall.size(); ++s) {
      result_.precision_recall[s] += evaluation.precision_recall[s];
    }
    result_.queries.push_back(evaluation);
  }

  RetrievalEvaluation Finish() {
    const int count = static_cast<int>(result_.queries.size());
    DivideBy(count, result_.mean);
    for (double& precision : result_.precision_recall) {
      if (count > 0) precision /= count;
    }
    for (auto& [name, entry] : class_of_name_) {
      DivideBy(entry.num_queries, entry.mean);
      result_.classes.push_back(entry);
    }
    return result_;
  }

 private:
  std::span<const std::string> classes_;
  std::map<std::string, ClassEvaluation> class_of_name_;
  RetrievalEvaluation result_;
};

}  // namespace

absl::StatusOr<RetrievalEvaluation> EvaluateScores(
    const Eigen::MatrixXd& scores, std::span<const std::string> classes) {
  const size_t n = classes.size();
  if (static_cast<size_t>(scores.rows()) != n ||
      scores.rows() != scores.cols()) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "%d x %d scores of %d items", scores.rows(), scores.cols(), n));
  }
  if (scores.hasNaN()) {
    return absl::InvalidArgumentError("a score is not a number");
  }
  Evaluator evaluator(classes);
  std::vector<int32_t> order(n);
  for (size_t q = 0; q < n; ++q) {
    const auto row = scores.row(static_cast<Eigen::Index>(q));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&row](int32_t a, int32_t b) { return row[a] > row[b]; });
    evaluator.Add(q, order);
  }
  return evaluator.Finish();
}

absl::StatusOr<RetrievalEvaluation> EvaluateRankedLists(
    std::span<const std::vector<int32_t>> ranked,
    std::span<const std::string> classes) {
  if (ranked.size() != classes.size()) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "%d rankings of %d items", ranked.size(), classes.size()));
  }
  Evaluator evaluator(classes);
  for (size_t q = 0; q < ranked.size(); ++q) {
    if (absl::Status status = CheckList(q, ranked[q], classes.size());
        !status.ok()) {
      return status;
    }
    evaluator.Add(q, ranked[q]);
  }
  return evaluator.Finish();
}

}  // namespace argmesh
