#include "tests/benchmark/codebook_training.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/random.h"
#include "core/containment/descriptor_table.h"
#include "tests/benchmark/labelled_collection.h"

namespace argmesh {
namespace {

constexpr size_t kForProjection = 8;  // windows of each level of each shape
constexpr size_t kForWords = 24;
constexpr int kIterations = 12;
constexpr double kBeyondRange = 0.0005;  // share of coordinates that is clamped
constexpr double kWhitening = 0.25;

using Dense = Eigen::MatrixXd;

// The first windows of every level: those of a level are in random order.
std::vector<const RawDescriptor*> Pick(const std::vector<TrainingShape>& shapes,
                                       size_t per_level) {
  std::vector<const RawDescriptor*> picked;
  for (const TrainingShape& shape : shapes) {
    for (const std::vector<RawDescriptor>& level : shape) {
      for (size_t i = 0; i < std::min(per_level, level.size()); ++i) {
        picked.push_back(&level[i]);
      }
    }
  }
  return picked;
}

void FitProjection(const std::vector<const RawDescriptor*>& sample,
                   WindowCodebook& codebook) {
  const auto n = static_cast<Eigen::Index>(sample.size());
  Dense rows(n, static_cast<Eigen::Index>(kRawDims));
  for (Eigen::Index i = 0; i < n; ++i) {
    rows.row(i) = sample[static_cast<size_t>(i)]->cast<double>().transpose();
  }
  const Eigen::RowVectorXd mean = rows.colwise().mean();
  rows.rowwise() -= mean;
  Eigen::VectorXd weight(static_cast<Eigen::Index>(kRawDims));
  const auto block = [&](size_t begin, size_t size) {
    const auto b = static_cast<Eigen::Index>(begin);
    const auto s = static_cast<Eigen::Index>(size);
    const double variance =
        rows.middleCols(b, s).squaredNorm() / static_cast<double>(n);
    weight.segment(b, s).setConstant(1 / std::sqrt(variance));
  };
  block(0, kSpinBins);
  block(kSpinBins, kNormalBins);
  block(kSpinBins + kNormalBins, kNormalBins);
  const Dense balanced = rows * weight.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Dense> solver(
      balanced.transpose() * balanced / static_cast<double>(n));
  Dense projection(static_cast<Eigen::Index>(kRawDims),
                   static_cast<Eigen::Index>(kWindowDims));
  for (Eigen::Index k = 0; k < projection.cols(); ++k) {
    const Eigen::Index from = projection.rows() - 1 - k;
    projection.col(k) =
        weight.asDiagonal() * solver.eigenvectors().col(from) *
        std::pow(std::max(1e-9, solver.eigenvalues()[from]), -kWhitening);
  }
  Dense projected = rows * projection;
  const double unit =
      std::sqrt(projected.squaredNorm() / static_cast<double>(n));
  projected /= unit;
  std::vector<double> sizes(projected.data(),
                            projected.data() + projected.size());
  for (double& x : sizes) x = std::abs(x);
  const auto last = sizes.begin() +
                    static_cast<std::ptrdiff_t>(
                        static_cast<double>(sizes.size()) * (1 - kBeyondRange));
  std::nth_element(sizes.begin(), last, sizes.end());
  codebook.unit = static_cast<float>(std::floor(127 / *last));
  codebook.mean = mean.transpose().cast<float>();
  codebook.projection = (projection * (codebook.unit / unit)).cast<float>();
}

std::vector<int32_t> AssignWords(const std::vector<WindowDescriptor>& rows,
                                 const std::vector<WindowDescriptor>& words,
                                 int threads) {
  const DescriptorTable table(words);
  std::vector<int32_t> word(rows.size());
  ParallelFor(rows.size(), threads, [&](size_t i) {
    word[i] = table.FindNearest<1>(rows[i])[0].row;
  });
  return word;
}

// Means of the rows of each word, rounded; an empty word becomes a random row.
std::vector<WindowDescriptor> MeanWords(
    const std::vector<WindowDescriptor>& rows, const std::vector<int32_t>& word,
    Random& random) {
  std::vector<std::array<int64_t, kWindowDims>> sums(kNumWindowWords);
  std::vector<int64_t> counts(kNumWindowWords, 0);
  for (size_t i = 0; i < rows.size(); ++i) {
    const auto w = static_cast<size_t>(word[i]);
    ++counts[w];
    for (size_t d = 0; d < kWindowDims; ++d) sums[w][d] += rows[i][d];
  }
  std::vector<WindowDescriptor> words(kNumWindowWords);
  for (size_t w = 0; w < words.size(); ++w) {
    if (counts[w] == 0) {
      words[w] = rows[static_cast<size_t>(random.Below(rows.size()))];
      continue;
    }
    for (size_t d = 0; d < kWindowDims; ++d) {
      words[w][d] = static_cast<int8_t>(std::lround(
          static_cast<double>(sums[w][d]) / static_cast<double>(counts[w])));
    }
  }
  return words;
}

void FitWords(const std::vector<TrainingShape>& shapes, uint64_t seed,
              int threads, WindowCodebook& codebook) {
  std::vector<WindowDescriptor> rows;
  for (const RawDescriptor* raw : Pick(shapes, kForWords)) {
    rows.push_back(codebook.Project(*raw));
  }
  Random random(seed);
  for (size_t i = rows.size(); i > 1; --i) {
    std::swap(rows[i - 1], rows[static_cast<size_t>(random.Below(i))]);
  }
  codebook.words.assign(rows.begin(),
                        rows.begin() + std::ptrdiff_t{kNumWindowWords});
  for (int i = 0; i < kIterations; ++i) {
    codebook.words =
        MeanWords(rows, AssignWords(rows, codebook.words, threads), random);
  }
}

void CountShares(const std::vector<TrainingShape>& shapes, int threads,
                 WindowCodebook& codebook) {
  for (size_t l = 0; l < codebook.share.size(); ++l) {
    std::vector<int64_t> counts(kNumWindowWords, 0);
    for (const TrainingShape& shape : shapes) {
      std::vector<WindowDescriptor> rows;
      for (const RawDescriptor& raw : shape[l]) {
        rows.push_back(codebook.Project(raw));
      }
      std::vector<int32_t> word = AssignWords(rows, codebook.words, threads);
      std::sort(word.begin(), word.end());
      word.erase(std::unique(word.begin(), word.end()), word.end());
      for (const int32_t w : word) ++counts[static_cast<size_t>(w)];
    }
    for (size_t w = 0; w < counts.size(); ++w) {
      codebook.share[l][w] = static_cast<uint8_t>(
          std::lround(255.0 * static_cast<double>(counts[w]) /
                      static_cast<double>(shapes.size())));
    }
  }
}

}  // namespace

WindowCodebook TrainWindowCodebook(const std::vector<TrainingShape>& shapes,
                                   uint64_t seed, int threads) {
  WindowCodebook codebook;
  FitProjection(Pick(shapes, kForProjection), codebook);
  FitWords(shapes, seed, threads, codebook);
  CountShares(shapes, threads, codebook);
  return codebook;
}

}  // namespace argmesh
