#include "client/cli/evaluation_run.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <utility>

#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "client/cli/evaluation_queries.h"
#include "client/cli/mesh_files.h"
#include "client/cli/progress_line.h"
#include "client/cli/query_mesh.h"
#include "client/error_status.h"
#include "client/resource_name.h"
#include "core/base/status_macros.h"
#include "core/evaluation/retrieval_metrics.h"

namespace argmesh {
namespace {

constexpr double kNoScore = std::numeric_limits<double>::quiet_NaN();

// What one query found: shapes of the gallery by rank with their scores.
struct RankedAnswer {
  absl::Status status;
  std::vector<size_t> ranked;
  std::vector<double> scores;     // of `ranked`
  std::vector<uint8_t> verified;  // of `ranked`: found to contain the query
};

class EvaluationJob {
 public:
  EvaluationJob(const Session& session, const EvaluateArguments& arguments)
      : session_(session), arguments_(arguments) {}

  absl::StatusOr<Evaluation> Run();

 private:
  absl::Status Prepare();
  absl::StatusOr<v1::SearchShapesRequest> MakeRequest(
      const EvaluationQuery& query) const;
  RankedAnswer Ask(const EvaluationQuery& query) const;
  void AskAll();
  void AddMeasures(size_t query, Evaluation& evaluation) const;
  int64_t SourceRank(size_t query_index) const;
  void AddSource(size_t query, Evaluation& evaluation) const;
  void FillMatrix(Evaluation& evaluation) const;
  absl::Status WriteScores() const;

  const Session& session_;
  const EvaluateArguments& arguments_;
  std::unique_ptr<Client> client_;
  Gallery gallery_{{}};
  std::vector<EvaluationQuery> queries_;
  std::vector<RankedAnswer> answers_;  // of the queries
  int limit_ = 1000;
};

absl::Status EvaluationJob::Prepare() {
  ARGMESH_ASSIGN_OR_RETURN(client_, session_.Connect());
  ARGMESH_ASSIGN_OR_RETURN(const v1::GetServerInfoResponse info,
                           client_->GetServerInfo());
  if (info.limits().max_search_limit() > 0) {
    limit_ = info.limits().max_search_limit();
  }
  ARGMESH_ASSIGN_OR_RETURN(
      gallery_,
      Gallery::Fetch(*client_, arguments_.match.collection, arguments_.filter));
  if (arguments_.queries.empty()) {
    queries_ = LeaveOneOutQueries(gallery_);
    if (queries_.empty()) {
      return absl::FailedPreconditionError(
          "no shape of the collection has a class; ingest with --labels");
    }
  } else {
    ARGMESH_ASSIGN_OR_RETURN(queries_,
                             ReadQueryTable(arguments_.queries, gallery_));
  }
  if (static_cast<int>(gallery_.shapes().size()) > limit_) {
    session_.Note(absl::StrFormat(
        "the server answers with %d of %d shapes; those behind count as not "
        "found",
        limit_, gallery_.shapes().size()));
  }
  return absl::OkStatus();
}

absl::StatusOr<v1::SearchShapesRequest> EvaluationJob::MakeRequest(
    const EvaluationQuery& query) const {
  const std::string& collection = arguments_.match.collection;
  v1::SearchShapesRequest request;
  request.set_parent(CollectionName(collection));
  if (query.file.empty()) {
    request.set_shape(ShapeName(collection, query.name));
    // Reranked, a query's double would vouch for its neighbours.
    request.set_exclude_query(arguments_.rerank);
  } else {
    ARGMESH_ASSIGN_OR_RETURN(*request.mutable_mesh(),
                             ReadQueryMesh(query.file));
  }
  request.set_mode(ModeOf(arguments_.match));
  *request.mutable_parameters() = ParametersOf(arguments_.match);
  request.mutable_parameters()->set_rerank(arguments_.rerank);
  request.set_filter(arguments_.filter);
  request.set_limit(limit_);
  request.set_exact(arguments_.exact);
  request.set_omit_component_pairs(true);
  return request;
}

RankedAnswer EvaluationJob::Ask(const EvaluationQuery& query) const {
  RankedAnswer answer;
  const auto request = MakeRequest(query);
  if (!request.ok()) return {request.status(), {}, {}, {}};
  const auto response = client_->SearchShapes(*request);
  if (!response.ok()) return {response.status(), {}, {}, {}};
  if (response->truncated()) {
    answer.status =
        absl::ResourceExhaustedError("the answer was cut to fit in a message");
  }
  for (const v1::Match& match : response->matches()) {
    // Shapes stored since the evaluation began do not count.
    const auto shape = gallery_.FindId(ResourceId(match.shape().name()));
    if (!shape) continue;
    answer.ranked.push_back(*shape);
    answer.scores.push_back(match.score());
    answer.verified.push_back(match.containment().verified() ? 1 : 0);
  }
  return answer;
}

void EvaluationJob::AskAll() {
  answers_.resize(queries_.size());
  ProgressLine progress(session_.err, session_.err_is_terminal, "evaluate",
                        queries_.size());
  std::mutex mutex;  // of `progress` and `done`
  size_t done = 0;
  std::atomic<size_t> next{0};
  std::atomic<bool> unreachable{false};
  const auto work = [&] {
    for (size_t i = next++; i < queries_.size(); i = next++) {
      // Without a server every further query would only wait in vain.
      answers_[i] =
          unreachable
              ? RankedAnswer{absl::UnavailableError("the server went away"),
                             {},
                             {},
                             {}}
              : Ask(queries_[i]);
      if (IsUnreachable(answers_[i].status)) unreachable = true;
      const std::lock_guard<std::mutex> lock(mutex);
      progress.Advance(++done);
    }
  };
  std::vector<std::thread> threads;
  for (int i = 1; i < arguments_.jobs; ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
}

void Add(const RetrievalMetrics& metrics, EvaluationMeasures& sum) {
  ++sum.queries;
  sum.nn += metrics.nearest_neighbor;
  sum.ft += metrics.first_tier;
  sum.st += metrics.second_tier;
  sum.e += metrics.e_measure;
  sum.dcg += metrics.dcg;
}

void DivideByQueries(EvaluationMeasures& sum) {
  if (sum.queries == 0) return;
  const auto count = static_cast<double>(sum.queries);
  for (double* value : {&sum.nn, &sum.ft, &sum.st, &sum.e, &sum.dcg}) {
    *value /= count;
  }
}

void EvaluationJob::AddMeasures(size_t query_index,
                                Evaluation& evaluation) const {
  const EvaluationQuery& query = queries_[query_index];
  int num_relevant = gallery_.CountOf(query.label);
  if (query.source && gallery_.shapes()[*query.source].label == query.label) {
    --num_relevant;
  }
  if (num_relevant == 0) {
    ++evaluation.skipped;
    return;
  }
  std::vector<uint8_t> relevant;
  for (const size_t shape : answers_[query_index].ranked) {
    const std::string& label = gallery_.shapes()[shape].label;
    if (shape == query.source || label.empty()) continue;
    relevant.push_back(label == query.label ? 1 : 0);
  }
  const RetrievalMetrics metrics = EvaluateRanking(relevant, num_relevant);
  Add(metrics, evaluation.mean);
  Add(metrics, evaluation.per_class[query.label]);
  QueryMeasures& own = evaluation.per_query.emplace_back();
  own.query = query.name;
  own.label = query.label;
  own.source_rank = SourceRank(query_index);
  Add(metrics, own.measures);
}

int64_t EvaluationJob::SourceRank(size_t query_index) const {
  const std::optional<size_t>& source = queries_[query_index].source;
  if (!source) return 0;
  const std::vector<size_t>& ranked = answers_[query_index].ranked;
  const auto found = std::find(ranked.begin(), ranked.end(), *source);
  return found == ranked.end() ? 0 : found - ranked.begin() + 1;
}

void EvaluationJob::AddSource(size_t query_index,
                              Evaluation& evaluation) const {
  const EvaluationQuery& query = queries_[query_index];
  if (!query.source) return;
  const RankedAnswer& answer = answers_[query_index];
  ++evaluation.with_source;
  const int64_t rank = SourceRank(query_index);
  if (rank == 1) evaluation.source_first += 1;
  if (rank >= 1 && rank <= 5) evaluation.source_top5 += 1;
  bool other = false;
  for (size_t r = 0; r < answer.ranked.size(); ++r) {
    if (answer.verified[r] == 0) continue;
    const std::string& label = gallery_.shapes()[answer.ranked[r]].label;
    if (answer.ranked[r] == query.source) evaluation.source_verified += 1;
    other |= !label.empty() && label != query.label;
  }
  evaluation.other_verified += other ? 1 : 0;
}

void EvaluationJob::FillMatrix(Evaluation& evaluation) const {
  std::set<std::string> names;
  for (const GalleryShape& shape : gallery_.shapes()) {
    if (!shape.label.empty()) names.insert(shape.label);
  }
  for (const EvaluationQuery& query : queries_) names.insert(query.label);
  evaluation.classes.assign(names.begin(), names.end());
  std::map<std::string, size_t> index;
  for (size_t i = 0; i < evaluation.classes.size(); ++i) {
    index[evaluation.classes[i]] = i;
  }
  const size_t size = evaluation.classes.size();
  std::vector<std::vector<double>> sums(size, std::vector<double>(size, 0));
  std::vector<std::vector<int64_t>> counts(size, std::vector<int64_t>(size, 0));
  for (size_t q = 0; q < queries_.size(); ++q) {
    const size_t row = index[queries_[q].label];
    for (size_t r = 0; r < answers_[q].ranked.size(); ++r) {
      const size_t shape = answers_[q].ranked[r];
      const std::string& label = gallery_.shapes()[shape].label;
      if (label.empty() || shape == queries_[q].source) continue;
      sums[row][index[label]] += answers_[q].scores[r];
      ++counts[row][index[label]];
    }
  }
  evaluation.matrix.assign(size, std::vector<double>(size, kNoScore));
  for (size_t i = 0; i < size; ++i) {
    for (size_t j = 0; j < size; ++j) {
      if (counts[i][j] == 0) continue;
      evaluation.matrix[i][j] = sums[i][j] / static_cast<double>(counts[i][j]);
    }
  }
}

absl::Status EvaluationJob::WriteScores() const {
  if (arguments_.scores.empty()) return absl::OkStatus();
  std::string text = "query\tclass";
  for (const GalleryShape& shape : gallery_.shapes()) text += '\t' + shape.id;
  text += '\n';
  for (size_t q = 0; q < queries_.size(); ++q) {
    std::vector<double> row(gallery_.shapes().size(), kNoScore);
    for (size_t r = 0; r < answers_[q].ranked.size(); ++r) {
      row[answers_[q].ranked[r]] = answers_[q].scores[r];
    }
    text += queries_[q].name + '\t' + queries_[q].label;
    for (const double score : row) {
      text += std::isnan(score) ? "\t" : absl::StrFormat("\t%.9g", score);
    }
    text += '\n';
  }
  return WriteFile(arguments_.scores, text);
}

absl::StatusOr<Evaluation> EvaluationJob::Run() {
  ARGMESH_RETURN_IF_ERROR(Prepare());
  const absl::Time start = absl::Now();
  AskAll();
  Evaluation evaluation;
  evaluation.collection = arguments_.match.collection;
  evaluation.mode = arguments_.match.mode;
  evaluation.has_sources = !arguments_.queries.empty();
  evaluation.seconds = absl::ToDoubleSeconds(absl::Now() - start);
  for (const GalleryShape& shape : gallery_.shapes()) {
    evaluation.shapes += shape.label.empty() ? 0 : 1;
  }
  for (size_t q = 0; q < queries_.size(); ++q) {
    if (!answers_[q].status.ok()) {
      if (IsUnreachable(answers_[q].status)) return answers_[q].status;
      evaluation.failures.push_back({queries_[q].name, answers_[q].status});
      continue;
    }
    AddMeasures(q, evaluation);
    AddSource(q, evaluation);
  }
  DivideByQueries(evaluation.mean);
  for (auto& [label, measures] : evaluation.per_class) {
    DivideByQueries(measures);
  }
  if (evaluation.with_source > 0) {
    for (double* share :
         {&evaluation.source_first, &evaluation.source_top5,
          &evaluation.source_verified, &evaluation.other_verified}) {
      *share /= static_cast<double>(evaluation.with_source);
    }
  }
  FillMatrix(evaluation);
  ARGMESH_RETURN_IF_ERROR(WriteScores());
  return evaluation;
}

}  // namespace

absl::StatusOr<Evaluation> RunEvaluation(const Session& session,
                                         const EvaluateArguments& arguments) {
  return EvaluationJob(session, arguments).Run();
}

std::vector<double> RowMargins(const std::vector<std::vector<double>>& matrix) {
  std::vector<double> margins;
  for (size_t i = 0; i < matrix.size(); ++i) {
    double rival = kNoScore;
    for (size_t j = 0; j < matrix[i].size(); ++j) {
      if (j != i) rival = std::fmax(rival, matrix[i][j]);
    }
    margins.push_back(matrix[i][i] - rival);
  }
  return margins;
}

}  // namespace argmesh
