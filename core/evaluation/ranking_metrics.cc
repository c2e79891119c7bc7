#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "core/evaluation/retrieval_metrics.h"

namespace argmesh {
namespace {

// What the item at a rank from 1 adds to the discounted cumulative gain.
double Gain(size_t rank) {
  return rank == 1 ? 1 : 1 / std::log2(static_cast<double>(rank));
}

int CountWithin(std::span<const uint8_t> relevant, int depth) {
  const size_t n = std::min(relevant.size(), static_cast<size_t>(depth));
  int hits = 0;
  for (size_t i = 0; i < n; ++i) hits += relevant[i] != 0 ? 1 : 0;
  return hits;
}

double EMeasure(std::span<const uint8_t> relevant, int num_relevant) {
  const int hits = CountWithin(relevant, kEMeasureDepth);
  if (hits == 0) return 0;
  const double precision = static_cast<double>(hits) / kEMeasureDepth;
  const double recall = static_cast<double>(hits) / num_relevant;
  return 2 * precision * recall / (precision + recall);
}

}  // namespace

RetrievalMetrics EvaluateRanking(std::span<const uint8_t> relevant,
                                 int num_relevant) {
  RetrievalMetrics metrics;
  metrics.nearest_neighbor = CountWithin(relevant, 1);
  metrics.first_tier =
      static_cast<double>(CountWithin(relevant, num_relevant)) / num_relevant;
  metrics.second_tier =
      static_cast<double>(CountWithin(relevant, 2 * num_relevant)) /
      num_relevant;
  metrics.e_measure = EMeasure(relevant, num_relevant);
  double gain = 0, perfect = 0, precision = 0;
  int hits = 0;
  for (size_t i = 0; i < relevant.size(); ++i) {
    if (relevant[i] == 0) continue;
    ++hits;
    gain += Gain(i + 1);
    precision += static_cast<double>(hits) / static_cast<double>(i + 1);
  }
  for (int i = 1; i <= num_relevant; ++i) {
    perfect += Gain(static_cast<size_t>(i));
  }
  metrics.dcg = gain / perfect;
  metrics.average_precision = precision / num_relevant;
  return metrics;
}

PrecisionRecall EvaluatePrecisionRecall(std::span<const uint8_t> relevant,
                                        int num_relevant) {
  PrecisionRecall curve{};
  int hits = 0;
  for (size_t i = 0; i < relevant.size(); ++i) {
    if (relevant[i] == 0) continue;
    ++hits;
    const double precision =
        static_cast<double>(hits) / static_cast<double>(i + 1);
    // Every step whose recall is reached here, in whole numbers:
    // (step + 1) / kRecallSteps <= hits / num_relevant.
    for (int step = 0; (step + 1) * num_relevant <= hits * kRecallSteps &&
                       step < kRecallSteps;
         ++step) {
      double& best = curve[static_cast<size_t>(step)];
      best = std::max(best, precision);
    }
  }
  return curve;
}

}  // namespace argmesh
