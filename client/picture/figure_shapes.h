// Figures of shapes: matched pairs, levels of a decomposition, modes with
// their windows, and ranked results.
//
// Fails    kInvalidArgument    labels that do not match the faces, nothing to
//                              show, an option outside its range
//          kResourceExhausted  the ray tracer refuses a mesh
// Cost     one RenderMesh a panel. Thread-safe.
#ifndef ARGMESH_CLIENT_PICTURE_FIGURE_SHAPES_H_
#define ARGMESH_CLIENT_PICTURE_FIGURE_SHAPES_H_

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "client/picture/figure.h"
#include "client/picture/render.h"
#include "core/mesh/triangle_mesh.h"

namespace argmesh {

// One of two matched shapes; `mesh` must outlive the call.
struct PairSide {
  const TriangleMesh* mesh = nullptr;
  // The number of the match a face belongs to, equal on both sides; -1 for
  // faces without one, which are pale grey.
  std::vector<int32_t> match_of_face = {};
  std::string caption = {};
};

absl::StatusOr<Figure> RenderPair(const PairSide& left, const PairSide& right,
                                  const FigureOptions& options = {});

struct LevelPanel {
  std::vector<int32_t> component_of_face = {};  // -1 for none
  std::string caption = {};
};

// Levels coarse to fine. A component keeps the colour of the one it lies in at
// the level before when it is that one's largest part.
absl::StatusOr<Figure> RenderLevels(const TriangleMesh& mesh,
                                    std::span<const LevelPanel> levels,
                                    const FigureOptions& options = {});

// Modes as dots and their windows as circles, from three sides.
absl::StatusOr<Figure> RenderModes(const TriangleMesh& mesh,
                                   std::vector<SurfaceMarker> modes,
                                   const FigureOptions& options = {});

// `mesh` must outlive the call.
struct RankedShape {
  const TriangleMesh* mesh = nullptr;
  std::string class_name = {};
  double score = 0;
  bool relevant = false;  // a green frame, else a red one
};

// The query first, then the results in the order given; `columns` 0 for six.
absl::StatusOr<Figure> RenderContactSheet(const TriangleMesh& query,
                                          const std::string& query_caption,
                                          std::span<const RankedShape> results,
                                          const FigureOptions& options = {});

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_PICTURE_FIGURE_SHAPES_H_
