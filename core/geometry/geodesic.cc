#include "core/geometry/geodesic.h"

#include <algorithm>
#include <cstddef>

namespace argmesh {
namespace {

constexpr float kUnreached = std::numeric_limits<float>::infinity();

}  // namespace

GeodesicSolver::GeodesicSolver(const SurfaceGraph& graph)
    : graph_(graph),
      distance_(static_cast<size_t>(graph.num_vertices()), kUnreached) {}

template <typename Admit>
std::span<const ReachedVertex> GeodesicSolver::Search(int source,
                                                      float max_distance,
                                                      const Admit& admit) {
  float* const distance = distance_.data();
  const int32_t* const offsets = graph_.offsets.data();
  const int32_t* const targets = graph_.targets.data();
  const float* const lengths = graph_.lengths.data();
  // Every vertex that was given a distance was reached in the end.
  for (const ReachedVertex& reached : reached_) {
    distance[reached.vertex] = kUnreached;
  }
  reached_.clear();
  queue_.Clear();
  distance[source] = 0;
  queue_.Push(0, source);
  while (!queue_.empty()) {
    const auto [d, v] = queue_.Pop();
    if (d > distance[v]) continue;
    reached_.push_back({v, d});
    for (int32_t e = offsets[v]; e < offsets[v + 1]; ++e) {
      const int32_t w = targets[e];
      const float through = d + lengths[e];
      if (through >= distance[w] || through > max_distance || !admit(w)) {
        continue;
      }
      distance[w] = through;
      queue_.Push(through, w);
    }
  }
  return reached_;
}

std::span<const ReachedVertex> GeodesicSolver::FindWithin(int source,
                                                          float max_distance) {
  return Search(source, max_distance, [](int32_t) { return true; });
}

std::span<const ReachedVertex> GeodesicSolver::FindWithinRegion(
    int source, std::span<const int32_t> region) {
  const int32_t* const region_of = region.data();
  const int32_t own = region_of[source];
  return Search(source, kUnreached,
                [=](int32_t w) { return region_of[w] == own; });
}

namespace {

// Gives every vertex nearer to `seed` than to its present seed over to `cell`.
void RelaxFrom(const SurfaceGraph& graph, int32_t seed, int32_t cell,
               VertexQueue& queue, FarthestPointCells& cells) {
  float* const distance = cells.distance.data();
  int32_t* const cell_of = cells.cell_of_vertex.data();
  distance[seed] = 0;
  cell_of[seed] = cell;
  queue.Push(0, seed);
  while (!queue.empty()) {
    const auto [d, v] = queue.Pop();
    if (d > distance[v]) continue;
    for (int32_t e = graph.offsets.data()[v]; e < graph.offsets.data()[v + 1];
         ++e) {
      const int32_t w = graph.targets.data()[e];
      const float through = d + graph.lengths.data()[e];
      if (through >= distance[w]) continue;
      distance[w] = through;
      cell_of[w] = cell;
      queue.Push(through, w);
    }
  }
}

// Distances within this share of the largest count as largest.
constexpr float kAboutLargest = 1e-3F;

}  // namespace

int32_t FindFarthest(std::span<const float> distance) {
  const float largest = *std::max_element(distance.begin(), distance.end());
  const float least = largest * (1 - kAboutLargest);
  const auto first =
      std::find_if(distance.begin(), distance.end(),
                   [least](float value) { return value >= least; });
  return static_cast<int32_t>(first - distance.begin());
}

FarthestPointCells ComputeFarthestPointCells(const SurfaceGraph& graph,
                                             int count, int first_seed) {
  const auto n = static_cast<size_t>(graph.num_vertices());
  FarthestPointCells cells;
  cells.cell_of_vertex.assign(n, 0);
  cells.distance.assign(n, kUnreached);
  VertexQueue queue;
  int32_t seed = first_seed;
  while (n > 0 && static_cast<int>(cells.seeds.size()) < count) {
    RelaxFrom(graph, seed, static_cast<int32_t>(cells.seeds.size()), queue,
              cells);
    cells.seeds.push_back(seed);
    seed = FindFarthest(cells.distance);
    if (!(cells.distance[static_cast<size_t>(seed)] > 0)) break;
  }
  return cells;
}

Eigen::VectorXd ComputeAverageGeodesicDistance(const SurfaceGraph& graph,
                                               const Eigen::VectorXd& areas,
                                               int num_sources) {
  const int n = graph.num_vertices();
  Eigen::VectorXd average = Eigen::VectorXd::Zero(n);
  const double total_area = areas.sum();
  if (n == 0 || !(total_area > 0)) return average;
  // Starting at an end of the surface makes the samples depend less on which
  // vertex is the first.
  const int32_t start =
      FindFarthest(ComputeFarthestPointCells(graph, 1, 0).distance);
  const FarthestPointCells cells =
      ComputeFarthestPointCells(graph, num_sources, start);
  Eigen::VectorXd weights =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(cells.seeds.size()));
  for (int v = 0; v < n; ++v) {
    weights[cells.cell_of_vertex.data()[v]] += areas[v] / total_area;
  }
  GeodesicSolver solver(graph);
  Eigen::VectorXd reached_weight = Eigen::VectorXd::Zero(n);
  double largest = 0;
  for (size_t s = 0; s < cells.seeds.size(); ++s) {
    const double weight = weights[static_cast<Eigen::Index>(s)];
    for (const auto& [v, distance] : solver.FindWithin(cells.seeds[s])) {
      average[v] += weight * static_cast<double>(distance);
      reached_weight[v] += weight;
      largest = std::max(largest, static_cast<double>(distance));
    }
  }
  average.array() += (1 - reached_weight.array()).max(0) * largest;
  return average;
}

}  // namespace argmesh
