#include "core/graph/node_attributes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

#include "core/graph/soft_histogram.h"

namespace argmesh {
namespace {

constexpr int kInsideSamples = 64;
constexpr int kWholeSamples = 150;
constexpr double kMinWaveKernel = 1e-6;

// Mean and standard deviation under weights.
struct Moments {
  double weight = 0, sum = 0, squares = 0;

  void Add(double value, double by) {
    weight += by;
    sum += by * value;
    squares += by * value * value;
  }
  double Mean() const { return weight > 0 ? sum / weight : 0; }
  double Deviation() const {
    if (weight <= 0) return 0;
    const double mean = Mean();
    return std::sqrt(std::max(0.0, squares / weight - mean * mean));
  }
};

// Everything one node is computed from.
struct NodeView {
  const SurfaceAbstraction& surface;
  const SampleTerms& terms;
  std::span<const int32_t> samples;
  double area;
  Eigen::Vector3d center;

  // Never 0, so that a node of samples without area keeps its attributes.
  double Weight(int32_t v) const {
    return std::max(surface.features.areas[v], 1e-15);
  }
};

NodeTuple ComputeTuple(const NodeView& node) {
  const SurfaceFeatures& features = node.surface.features;
  const double root = std::sqrt(node.area);
  Moments mean, gauss;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const int32_t v : node.samples) {
    const double a = node.Weight(v);
    mean.Add(features.mean_curvature[v], a);
    gauss.Add(features.gauss_curvature[v], a);
    normal += a * features.normals.row(v).transpose();
  }
  normal /= mean.weight;
  NodeTuple tuple;
  tuple.normal_deviation = static_cast<float>(
      std::sqrt(std::clamp(1 - normal.squaredNorm(), 0.0, 1.0)));
  tuple.gauss_deviation =
      static_cast<float>(std::asinh(node.area * gauss.Deviation()));
  tuple.gauss_mean = static_cast<float>(std::asinh(node.area * gauss.Mean()));
  tuple.mean_deviation =
      static_cast<float>(std::asinh(root * mean.Deviation()));
  tuple.mean_mean = static_cast<float>(std::asinh(root * mean.Mean()));
  tuple.log2_relative_area =
      static_cast<float>(std::log2(std::min(1.0, node.area)));
  return tuple;
}

// Distances along the surface from the node's centre, inside the node.
void AddInsideGeodesics(const NodeView& node,
                        std::span<const ReachedVertex> reached,
                        NodeTuple& tuple) {
  Moments distance;
  for (const ReachedVertex& r : reached) {
    distance.Add(static_cast<double>(r.distance), node.Weight(r.vertex));
  }
  const double root = std::sqrt(node.area);
  tuple.geodesic_deviation = static_cast<float>(distance.Deviation() / root);
  tuple.geodesic_mean = static_cast<float>(distance.Mean() / root);
}

void AddSampleHistograms(const NodeView& node, NodeHistograms& histograms) {
  SoftHistogram<10> diameter, geodesic, relative;
  SoftHistogram<9> index;
  SoftHistogram<8> curvedness;
  const double log2_root = 0.5 * std::log2(node.area);
  for (const int32_t v : node.samples) {
    const double a = node.Weight(v);
    const auto i = static_cast<size_t>(v);
    diameter.Add((node.terms.log2_diameter[i] + 7) / 7, a);
    relative.Add((node.terms.log2_diameter[i] - log2_root + 4) / 5, a);
    geodesic.Add((node.surface.features.average_geodesic[v] - 0.2) / 1.6, a);
    index.Add((node.terms.shape_index[i] + 1) / 2, a);
    curvedness.Add(node.terms.log2_curvedness[i] / 7, a);
  }
  histograms.shape_diameter = diameter.Normalized();
  histograms.relative_diameter = relative.Normalized();
  histograms.average_geodesic = geodesic.Normalized();
  histograms.shape_index = index.Normalized();
  histograms.curvedness = curvedness.Normalized();
}

// How far apart pairs of points lie: inside the node, and from it to the
// whole shape (the D2 distribution, restricted).
void AddPairHistograms(const NodeView& node, NodeHistograms& histograms) {
  const std::vector<int32_t> inside = StratifiedSamples(
      node.samples, node.surface.features.areas, kInsideSamples);
  const VertexMatrix& V = node.surface.samples.V;
  const double unit = 2 * std::sqrt(node.area);
  SoftHistogram<10> internal, outer;
  for (size_t i = 0; i < inside.size(); ++i) {
    internal.Add(0, 1);
    for (size_t j = 0; j < i; ++j) {
      internal.Add((V.row(inside[i]) - V.row(inside[j])).norm() / unit, 2);
    }
    for (const int32_t w : node.terms.whole) {
      outer.Add((V.row(inside[i]) - V.row(w)).norm() / 1.6, 1);
    }
  }
  histograms.internal_distance = internal.Normalized();
  histograms.outer_distance = outer.Normalized();
}

std::array<float, 16> MeanWaveKernel(const NodeView& node) {
  const Eigen::MatrixXd& signature = node.surface.features.wave_kernel;
  std::array<float, 16> logs{};
  double weight = 0;
  Eigen::Matrix<double, 16, 1> sum = Eigen::Matrix<double, 16, 1>::Zero();
  for (const int32_t v : node.samples) {
    weight += node.Weight(v);
    sum += node.Weight(v) * signature.row(v).transpose();
  }
  for (size_t q = 0; q < logs.size(); ++q) {
    logs[q] = static_cast<float>(std::log(
        std::max(kMinWaveKernel, sum[static_cast<Eigen::Index>(q)] / weight)));
  }
  return logs;
}

}  // namespace

SampleTerms::SampleTerms(const SurfaceAbstraction& surface) {
  const SurfaceFeatures& features = surface.features;
  const int n = surface.samples.num_vertices();
  for (int v = 0; v < n; ++v) {
    const double H = features.mean_curvature[v];
    const double K = features.gauss_curvature[v];
    // Principal curvatures are H +- root.
    const double root = std::sqrt(std::max(0.0, H * H - K));
    log2_diameter.push_back(
        std::log2(std::max(features.shape_diameter[v], kMinDiameter)));
    shape_index.push_back(2 / std::numbers::pi * std::atan2(H, root + 1e-9));
    log2_curvedness.push_back(
        std::log2(0.5 * std::sqrt(std::max(1e-6, 2 * H * H - K))));
  }
  std::vector<int32_t> all(static_cast<size_t>(n));
  std::iota(all.begin(), all.end(), 0);
  whole = StratifiedSamples(all, features.areas, kWholeSamples);
}

std::vector<ArgNode> ComputeNodeAttributes(
    const SurfaceAbstraction& surface, const SampleTerms& terms,
    const NodeMembers& members, std::span<const int32_t> node_of_sample,
    GeodesicSolver& solver) {
  std::vector<ArgNode> nodes;
  for (int c = 0; c < members.num_nodes(); ++c) {
    const auto i = static_cast<size_t>(c);
    const NodeView view = {surface, terms, members.Of(c), members.area[i],
                           members.center[i]};
    ArgNode node;
    node.tuple = ComputeTuple(view);
    AddInsideGeodesics(
        view, solver.FindWithinRegion(members.center_sample[i], node_of_sample),
        node.tuple);
    AddSampleHistograms(view, node.histograms);
    AddPairHistograms(view, node.histograms);
    node.wave_kernel = MeanWaveKernel(view);
    node.area = static_cast<float>(std::min(1.0, view.area));
    for (size_t d = 0; d < 3; ++d) {
      node.center[d] =
          static_cast<float>(view.center[static_cast<Eigen::Index>(d)]);
    }
    nodes.push_back(node);
  }
  return nodes;
}

}  // namespace argmesh
