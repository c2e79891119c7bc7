#include "core/abstraction/voronoi_regions.h"

#include <algorithm>

namespace argmesh {

int FarthestFromOrigin(const TriangleMesh& samples) {
  const Eigen::VectorXf distance = samples.V.rowwise().norm().cast<float>();
  return FindFarthest({distance.data(), static_cast<size_t>(distance.size())});
}

FarthestPointCells ComputeUniformCells(const TriangleMesh& samples,
                                       const SurfaceGraph& geodesic_graph,
                                       int count) {
  return ComputeFarthestPointCells(geodesic_graph, count,
                                   FarthestFromOrigin(samples));
}

Decomposition DecomposeByVoronoi(const DecompositionInput& input,
                                 const DecompositionOptions& options) {
  std::vector<int> counts;
  for (const int count : options.level_counts) {
    if (count < options.voronoi_cells) counts.push_back(count);
  }
  counts.push_back(options.voronoi_cells);

  FarthestPointCells finest = ComputeUniformCells(
      input.samples, input.geodesic_graph, options.voronoi_cells);
  Decomposition result;
  result.num_regions = static_cast<int>(finest.seeds.size());
  result.region_of_sample = std::move(finest.cell_of_vertex);

  // From fine to coarse: the cell of a seed in the coarser sampling. The
  // coarser seeds are a prefix of the finer ones.
  std::vector<DecompositionLevel> levels(counts.size());
  std::vector<int32_t> cell_of_region(finest.seeds.size());
  for (size_t r = 0; r < cell_of_region.size(); ++r) {
    cell_of_region[r] = static_cast<int32_t>(r);
  }
  for (size_t back = counts.size(); back-- > 0;) {
    DecompositionLevel& level = levels[back];
    level.count = counts[back];
    if (back + 1 < counts.size()) {
      const FarthestPointCells coarse = ComputeUniformCells(
          input.samples, input.geodesic_graph, counts[back]);
      DecompositionLevel& finer = levels[back + 1];
      for (int c = 0; c < finer.num_components; ++c) {
        const int32_t seed = finest.seeds[static_cast<size_t>(c)];
        finer.parent.push_back(
            coarse.cell_of_vertex[static_cast<size_t>(seed)]);
      }
      for (int32_t& cell : cell_of_region) {
        cell = finer.parent[static_cast<size_t>(cell)];
      }
      level.num_components = static_cast<int>(coarse.seeds.size());
    } else {
      level.num_components = result.num_regions;
    }
    level.component_of_region = cell_of_region;
  }
  levels.front().parent.assign(
      static_cast<size_t>(levels.front().num_components), -1);
  result.levels = std::move(levels);
  return result;
}

}  // namespace argmesh
