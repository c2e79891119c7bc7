// The neighbourhood graph of a sampled surface.
//
// Three kinds of links: the edges of the mesh; diagonals, the straight line
// across the two unfolded faces of an interior edge, which make shortest paths
// nearly geodesic; and bridges, short links between samples of different
// components that lie close together, plus the shortest links that make the
// graph connected. With bridges every pair of samples has a finite distance.
//
// Input    a mesh without unused vertices.
// Repeats  equal input gives bit-equal output; links are sorted by target.
// Cost     O(n log n) for n samples. Thread-safe.
#ifndef ARGMESH_CORE_GEOMETRY_SURFACE_GRAPH_H_
#define ARGMESH_CORE_GEOMETRY_SURFACE_GRAPH_H_

#include <cstdint>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace argmesh {

enum class LinkKind : uint8_t { kEdge, kDiagonal, kBridge };

// Compressed rows: links of vertex v are offsets[v] .. offsets[v+1]; each link
// stands in both directions.
struct SurfaceGraph {
  std::vector<int32_t> offsets;
  std::vector<int32_t> targets;
  std::vector<float> lengths;  // > 0, in the mesh's unit
  std::vector<LinkKind> kinds;
  // Component of each vertex by kEdge links, counted from 0 by first vertex.
  std::vector<int32_t> component_of_vertex;
  int num_components = 0;

  int num_vertices() const { return static_cast<int>(offsets.size()) - 1; }
};

struct SurfaceGraphOptions {
  bool diagonals = true;
  bool bridges = true;
  // Bridges join samples of different components closer than this many mean
  // edge lengths. 0 .. 10
  double bridge_radius = 1.0;
};

SurfaceGraph BuildSurfaceGraph(const TriangleMesh& mesh,
                               const SurfaceGraphOptions& options = {});

}  // namespace argmesh

#endif  // ARGMESH_CORE_GEOMETRY_SURFACE_GRAPH_H_
