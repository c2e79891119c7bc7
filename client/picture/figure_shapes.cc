#include "client/picture/figure_shapes.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "client/picture/palette.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr RgbColor kShape = {176, 190, 210};

RenderOptions PanelOptions(const FigureOptions& options) {
  RenderOptions render = options.render;
  render.width = options.panel_width;
  render.height = options.panel_height;
  return render;
}

absl::Status CheckLabels(size_t labels, const TriangleMesh& mesh) {
  if (labels == static_cast<size_t>(mesh.num_faces())) {
    return absl::OkStatus();
  }
  return absl::InvalidArgumentError(
      absl::StrFormat("%d labels for %d faces", labels, mesh.num_faces()));
}

absl::StatusOr<Panel> MakeSidePanel(const PairSide& side,
                                    const FigureOptions& options) {
  if (side.mesh == nullptr) {
    return absl::InvalidArgumentError("a side of the pair has no mesh");
  }
  ARGMESH_RETURN_IF_ERROR(CheckLabels(side.match_of_face.size(), *side.mesh));
  ARGMESH_ASSIGN_OR_RETURN(
      Image image, RenderMesh(*side.mesh, ColorsOfLabels(side.match_of_face),
                              PanelOptions(options)));
  return Panel{.image = std::move(image), .caption = side.caption};
}

// Colours of a level by those of the level before: the largest part of a
// coarser component keeps its colour, the others take new ones.
class LevelColors {
 public:
  std::vector<int32_t> Next(const std::vector<int32_t>& labels) {
    const std::map<int32_t, std::map<int32_t, int>> overlaps =
        CountOverlaps(labels);
    // Ascending label decides between equally large parts.
    std::map<int32_t, std::pair<int, int32_t>> heir;  // colour: size, label
    for (const auto& [label, colors] : overlaps) {
      for (const auto& [color, size] : colors) {
        auto& best = heir[color];
        if (size > best.first) best = {size, label};
      }
    }
    std::map<int32_t, int32_t> color_of;
    for (const auto& [color, best] : heir) {
      if (color >= 0) color_of.try_emplace(best.second, color);
    }
    for (const auto& [label, colors] : overlaps) {
      if (color_of.try_emplace(label, next_color_).second) ++next_color_;
    }
    before_.clear();
    for (const int32_t label : labels) {
      before_.push_back(label < 0 ? -1 : color_of[label]);
    }
    return before_;
  }

 private:
  std::map<int32_t, std::map<int32_t, int>> CountOverlaps(
      const std::vector<int32_t>& labels) const {
    std::map<int32_t, std::map<int32_t, int>> overlaps;
    for (size_t f = 0; f < labels.size(); ++f) {
      if (labels[f] < 0) continue;
      ++overlaps[labels[f]][before_.empty() ? -1 : before_[f]];
    }
    return overlaps;
  }

  std::vector<int32_t> before_;
  int32_t next_color_ = 0;
};

}  // namespace

absl::StatusOr<Figure> RenderPair(const PairSide& left, const PairSide& right,
                                  const FigureOptions& options) {
  ARGMESH_RETURN_IF_ERROR(CheckFigureOptions(options));
  std::vector<Panel> panels;
  for (const PairSide* side : {&left, &right}) {
    ARGMESH_ASSIGN_OR_RETURN(Panel panel, MakeSidePanel(*side, options));
    panels.push_back(std::move(panel));
  }
  return Compose(panels, options);
}

absl::StatusOr<Figure> RenderLevels(const TriangleMesh& mesh,
                                    std::span<const LevelPanel> levels,
                                    const FigureOptions& options) {
  ARGMESH_RETURN_IF_ERROR(CheckFigureOptions(options));
  std::vector<Panel> panels;
  LevelColors colors;
  for (const LevelPanel& level : levels) {
    ARGMESH_RETURN_IF_ERROR(CheckLabels(level.component_of_face.size(), mesh));
    ARGMESH_ASSIGN_OR_RETURN(
        Image image,
        RenderMesh(mesh, ColorsOfLabels(colors.Next(level.component_of_face)),
                   PanelOptions(options)));
    panels.push_back({.image = std::move(image), .caption = level.caption});
  }
  return Compose(panels, options);
}

absl::StatusOr<Figure> RenderModes(const TriangleMesh& mesh,
                                   std::vector<SurfaceMarker> modes,
                                   const FigureOptions& options) {
  ARGMESH_RETURN_IF_ERROR(CheckFigureOptions(options));
  RenderOptions render = PanelOptions(options);
  render.markers = std::move(modes);
  std::vector<Panel> panels;
  for (int side = 0; side < 3; ++side) {
    ARGMESH_ASSIGN_OR_RETURN(Image image, RenderMesh(mesh, kShape, render));
    panels.push_back({.image = std::move(image)});
    render.view.yaw_degrees += 120;
  }
  return Compose(panels, options);
}

absl::StatusOr<Figure> RenderContactSheet(const TriangleMesh& query,
                                          const std::string& query_caption,
                                          std::span<const RankedShape> results,
                                          const FigureOptions& options) {
  ARGMESH_RETURN_IF_ERROR(CheckFigureOptions(options));
  const RenderOptions render = PanelOptions(options);
  std::vector<Panel> panels;
  ARGMESH_ASSIGN_OR_RETURN(Image query_image,
                           RenderMesh(query, CategoricalColor(1), render));
  panels.push_back({.image = std::move(query_image),
                    .caption = query_caption,
                    .frame = kInk});
  for (size_t i = 0; i < results.size(); ++i) {
    const RankedShape& result = results[i];
    if (result.mesh == nullptr) {
      return absl::InvalidArgumentError(
          absl::StrFormat("result %d has no mesh", i));
    }
    ARGMESH_ASSIGN_OR_RETURN(Image image,
                             RenderMesh(*result.mesh, kShape, render));
    panels.push_back(
        {.image = std::move(image),
         .caption = absl::StrFormat("%d  %s  %.3f", i + 1, result.class_name,
                                    result.score),
         .frame = result.relevant ? kGood : kBad});
  }
  FigureOptions sheet = options;
  if (sheet.columns == 0) sheet.columns = 6;
  return Compose(panels, sheet);
}

}  // namespace argmesh
