// The hierarchical attributed relational graph (ARG) of a shape.
//
// Source   "Hierarchical Surface Abstraction Using Adaptive Mean Shift",
//          sections 3.4 and 4, with the corrections of docs/algorithm.md.
// Units    lengths in sqrt(area of the shape), areas as shares of it.
#ifndef ARGMESH_CORE_GRAPH_SHAPE_GRAPH_H_
#define ARGMESH_CORE_GRAPH_SHAPE_GRAPH_H_

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/status.h"

namespace argmesh {

// The version of what is computed and stored; graphs of different versions
// are never compared.
inline constexpr uint32_t kShapeGraphVersion = 1;

// The paper's tuple V_c, eq. 4, similarity-invariant: A is the area of the
// node, curvatures through asinh.
struct NodeTuple {
  float normal_deviation = 0;    // 0 .. 1
  float gauss_deviation = 0;     // asinh(A * sd K)
  float gauss_mean = 0;          // asinh(A * mean K)
  float mean_deviation = 0;      // asinh(sqrt(A) * sd H)
  float mean_mean = 0;           // asinh(sqrt(A) * mean H)
  float geodesic_deviation = 0;  // sd of distances from the centre / sqrt(A)
  float geodesic_mean = 0;       // mean of the same
  float log2_relative_area = 0;  // <= 0

  bool operator==(const NodeTuple&) const = default;
};

// Area-weighted soft histograms, each summing to 1.
struct NodeHistograms {
  std::array<float, 10> shape_diameter{};     // (log2 d + 7) / 7
  std::array<float, 10> average_geodesic{};   // (g - 0.2) / 1.6
  std::array<float, 9> shape_index{};         // (S + 1) / 2
  std::array<float, 8> curvedness{};          // log2(0.5 sqrt(2H^2 - K)) / 7
  std::array<float, 10> internal_distance{};  // pairs inside / (2 sqrt(A))
  std::array<float, 10> outer_distance{};     // to the whole shape / 1.6
  // (log2(d / sqrt(A)) + 4) / 5
  std::array<float, 10> relative_diameter{};

  bool operator==(const NodeHistograms&) const = default;
};

struct ArgNode {
  NodeTuple tuple;
  NodeHistograms histograms;
  std::array<float, 16> wave_kernel{};  // log of the mean signature
  float area = 0;                       // share of the shape, > 0
  std::array<float, 3> center{};        // area centroid, unit-area frame
  int32_t parent = -1;                  // node of the level before, -1: none

  bool operator==(const ArgNode&) const = default;
};

// An edge of two adjacent components.
struct ArgEdge {
  int32_t a = 0;
  int32_t b = 0;            // a < b
  float geodesic = 0;       // average geodesic distance
  float border_length = 0;  // > 0 along the surface; 0 across a gap

  bool operator==(const ArgEdge&) const = default;
};

struct ArgLevel {
  double threshold = 0;  // Ncut threshold of the level; 0 when by count
  int32_t count = 0;     // asked-for components; 0 when by threshold
  std::vector<ArgNode> nodes;
  std::vector<ArgEdge> edges;  // sorted by (a, b)
  // Average geodesic distances of all pairs i < j, row after row:
  // (0,1) (0,2) .. (0,k-1) (1,2) ..; k (k-1) / 2 values.
  std::vector<float> distances;

  int num_nodes() const { return static_cast<int>(nodes.size()); }
  // 0 for i == j.
  float Distance(int i, int j) const;

  bool operator==(const ArgLevel&) const = default;
};

struct ArgMode {
  std::array<float, 3> position{};  // unit-area frame
  float window = 0;                 // w_max
  int32_t repeatability = 1;
  float density = 0;
  float offset = 0;
  int32_t node = 0;  // of the finest component level

  bool operator==(const ArgMode&) const = default;
};

struct ShapeGraph {
  // Components, coarse to fine, nested: a node's parent is in the level before.
  std::vector<ArgLevel> levels;
  // Equal-sized cells beside the components; parents are the nodes of the
  // finest level that hold most of their area. No nodes when not computed.
  ArgLevel uniform;
  std::vector<ArgMode> modes;
  std::array<double, 3> centroid{};  // x_unit = (x - centroid) * scale
  double scale = 1;
  int32_t num_components = 1;  // connected pieces of the surface
  uint32_t decomposition = 0;  // DecompositionKind

  bool operator==(const ShapeGraph&) const = default;
};

// The limits of a well-formed graph.
inline constexpr int kMaxGraphLevels = 64;
inline constexpr int kMaxGraphNodes = 4096;  // of one level

// kInvalidArgument naming the level, the item and the limit when `graph` is
// not well formed: counts, parents and edges in range and in order, all
// distances there, histograms 0 .. 1, areas in (0, 1], everything finite.
absl::Status CheckShapeGraph(const ShapeGraph& graph);

// Names of the levels, coarse to fine, then "uniform": "ncut-1.6", "count-16".
std::vector<std::string> LevelNames(const ShapeGraph& graph);

// Component of every face of the mesh as uploaded, -1 for dropped faces.
struct FaceLabels {
  std::vector<int16_t> component;  // node of the finest component level
  std::vector<int16_t> uniform;    // node of the uniform level; may be empty

  bool operator==(const FaceLabels&) const = default;
};

// Labels at a coarser level by following parents. `level` 0 .. levels-1.
std::vector<int16_t> LabelsAtLevel(const ShapeGraph& graph,
                                   const FaceLabels& labels, int level);

}  // namespace argmesh

#endif  // ARGMESH_CORE_GRAPH_SHAPE_GRAPH_H_
