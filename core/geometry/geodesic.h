// Distances along a surface: Dijkstra on a SurfaceGraph.
//
// With diagonals the error against exact geodesics is below 5 % on regular
// meshes; always >= the exact polyhedral distance along the surface.
#ifndef ARGMESH_CORE_GEOMETRY_GEODESIC_H_
#define ARGMESH_CORE_GEOMETRY_GEODESIC_H_

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/geometry/surface_graph.h"
#include "core/geometry/vertex_queue.h"

namespace argmesh {

struct ReachedVertex {
  int32_t vertex;
  float distance;
};

// Runs many searches over one graph and keeps its scratch memory between them.
// One solver belongs to one thread; the graph must outlive it.
class GeodesicSolver {
 public:
  explicit GeodesicSolver(const SurfaceGraph& graph);

  // Vertices within `max_distance` of `source`, nearest first, ties by index;
  // valid until the next call. Cost O(k log k) for k reached vertices.
  std::span<const ReachedVertex> FindWithin(
      int source, float max_distance = std::numeric_limits<float>::infinity());

  // The same, over the vertices v with region[v] == region[source] only.
  std::span<const ReachedVertex> FindWithinRegion(
      int source, std::span<const int32_t> region);

 private:
  template <typename Admit>
  std::span<const ReachedVertex> Search(int source, float max_distance,
                                        const Admit& admit);

  const SurfaceGraph& graph_;
  std::vector<float> distance_;
  std::vector<ReachedVertex> reached_;
  VertexQueue queue_;
};

// Voronoi cells of farthest-point samples.
struct FarthestPointCells {
  std::vector<int32_t> seeds;           // vertex of each cell
  std::vector<int32_t> cell_of_vertex;  // 0 .. seeds.size()-1
  std::vector<float> distance;          // of each vertex to its seed
};

// The first vertex, of at least one, whose distance is within a thousandth of
// the largest: a symmetric surface has several that rounding would tell apart.
int32_t FindFarthest(std::span<const float> distance);

// Greedy farthest-point sampling from `first_seed` by FindFarthest. Fewer than
// `count` cells when every vertex is a seed. Cost O(count * n log n) at worst,
// far less in practice. Thread-safe.
FarthestPointCells ComputeFarthestPointCells(const SurfaceGraph& graph,
                                             int count, int first_seed);

// Average geodesic distance of each vertex to the surface, over `num_sources`
// farthest-point samples weighted by their cells' areas (sum of `areas`
// normalised to 1). A sample that cannot be reached counts as the largest
// finite distance. Source: Hilaga et al., "Topology Matching", SIGGRAPH 2001.
Eigen::VectorXd ComputeAverageGeodesicDistance(const SurfaceGraph& graph,
                                               const Eigen::VectorXd& areas,
                                               int num_sources = 64);

}  // namespace argmesh

#endif  // ARGMESH_CORE_GEOMETRY_GEODESIC_H_
