#include "client/picture/render.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "client/picture/parallel_rows.h"
#include "client/picture/ray_scene.h"
#include "client/picture/sky_openness.h"
#include "client/picture/surface_lines.h"
#include "client/picture/surface_shader.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

using Eigen::Vector3f;

constexpr int kSub = SubpixelGrid::kSub;
constexpr float kShadowStrength = 0.55F;
constexpr float kShadowFade = 0.12F;  // of the smaller side

absl::Status CheckOptions(const RenderOptions& options) {
  const auto in_range = [](const char* name, double value, double low,
                           double high) {
    if (value >= low && value <= high) return absl::OkStatus();
    return absl::InvalidArgumentError(
        absl::StrFormat("%s %g is outside %g .. %g", name, value, low, high));
  };
  ARGMESH_RETURN_IF_ERROR(in_range("width", options.width, 1, 4096));
  ARGMESH_RETURN_IF_ERROR(in_range("height", options.height, 1, 4096));
  ARGMESH_RETURN_IF_ERROR(
      in_range("ambient_rays", options.ambient_rays, 0, 1024));
  ARGMESH_RETURN_IF_ERROR(
      in_range("crease_degrees", options.crease_degrees, 0, 180));
  ARGMESH_RETURN_IF_ERROR(in_range("dot_pixels", options.dot_pixels, 0, 4096));
  ARGMESH_RETURN_IF_ERROR(in_range("threads", options.threads, 0, 256));
  return in_range("view.margin", options.view.margin, 0, 0.4);
}

class Renderer {
 public:
  Renderer(const TriangleMesh& mesh, std::span<const RgbColor> face_colors,
           const RayScene& scene, const View& view,
           const RenderOptions& options)
      : face_colors_(face_colors),
        scene_(scene),
        options_(options),
        shader_(mesh, face_colors, scene, view, options),
        hits_(static_cast<size_t>(options.width) *
              static_cast<size_t>(options.height)),
        subpixels_(options.width, options.height) {
    if (options.ground_shadow) ground_ = FindGround(mesh, view);
  }

  Image Render() {
    const int rows = options_.height;
    ParallelRows(rows, options_.threads, [this](int y) { LookAlongRow(y); });
    const SkyOpenness sky(scene_, shader_, hits_, ground_, options_);
    Image image(options_.width, options_.height, options_.background);
    ParallelRows(rows, options_.threads,
                 [&](int y) { ShadeRow(y, sky, image); });
    if (options_.lines) {
      ParallelRows(rows, options_.threads,
                   [&](int y) { DrawLinesOfRow(subpixels_, y, image); });
    }
    return image;
  }

 private:
  GroundPlane FindGround(const TriangleMesh& mesh, const View& view) const {
    GroundPlane ground;
    ground.normal = scene_.DirectionToPicture(view.ground_normal);
    ground.offset = std::numeric_limits<float>::infinity();
    for (int v = 0; v < mesh.num_vertices(); ++v) {
      ground.offset = std::min(
          ground.offset, ground.normal.dot(scene_.ToPicture(mesh.vertex(v))));
    }
    return ground;
  }

  size_t PixelNumber(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(options_.width) +
           static_cast<size_t>(x);
  }

  void LookAlongRow(int y) {
    for (int x = 0; x < options_.width; ++x) {
      hits_[PixelNumber(x, y)] = scene_.Look(static_cast<float>(x) + 0.5F,
                                             static_cast<float>(y) + 0.5F);
    }
  }

  // Whether a neighbouring pixel shows something else, so that one ray in the
  // middle does not tell what this pixel shows.
  bool NeedsSubpixels(int x, int y) const {
    const RayHit& own = hits_[PixelNumber(x, y)];
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, options_.height - 1);
         ++j) {
      for (int i = std::max(x - 1, 0); i <= std::min(x + 1, options_.width - 1);
           ++i) {
        const RayHit& other = hits_[PixelNumber(i, j)];
        if ((own.face < 0) != (other.face < 0)) return true;
        if (own.face < 0 || own.face == other.face) continue;
        if (ColorOf(own) != ColorOf(other)) return true;
        const Vector3f normal = shader_.Normal(own);
        if (normal.dot(shader_.Normal(other)) < 0.9F) return true;
        const float slope = 3.0F / std::max(normal.z(), 0.1F);
        if (std::abs(own.z - other.z) > slope) return true;
      }
    }
    return !options_.markers.empty() && own.face >= 0;
  }

  const RgbColor& ColorOf(const RayHit& hit) const {
    return face_colors_[static_cast<size_t>(hit.face)];
  }

  int32_t LineKey(const RayHit& hit) const {
    if (hit.face < 0) return -1;
    const RgbColor& color = ColorOf(hit);
    return color[0] << 16 | color[1] << 8 | color[2];
  }

  // 1 inside, falling to 0 at the edge of the picture.
  float FadeAt(float x, float y) const {
    const auto width = static_cast<float>(options_.width);
    const auto height = static_cast<float>(options_.height);
    const float border = std::min({x, y, width - x, height - y});
    return std::clamp(border / (kShadowFade * std::min(width, height)), 0.0F,
                      1.0F);
  }

  Vector3f Shade(const RayHit& hit, float x, float y, float openness) const {
    if (hit.face >= 0) return shader_.Color(hit, {x, y, hit.z}, openness);
    const RgbColor& back = options_.background;
    const float light =
        ground_ ? 1 - kShadowStrength * FadeAt(x, y) * (1 - openness) : 1;
    return Vector3f(back[0], back[1], back[2]) * light;
  }

  void ShadeRow(int y, const SkyOpenness& sky, Image& image) {
    for (int x = 0; x < options_.width; ++x) {
      const RayHit& hit = hits_[PixelNumber(x, y)];
      Vector3f color;
      if (NeedsSubpixels(x, y)) {
        color = ShadeSubpixels(x, y, sky);
      } else {
        color = Shade(hit, static_cast<float>(x) + 0.5F,
                      static_cast<float>(y) + 0.5F, sky.At(x, y));
        subpixels_.Fill(x, y, LineKey(hit), hit.z);
      }
      image.Set(x, y,
                {static_cast<uint8_t>(std::lround(color[0])),
                 static_cast<uint8_t>(std::lround(color[1])),
                 static_cast<uint8_t>(std::lround(color[2]))});
    }
  }

  Vector3f ShadeSubpixels(int x, int y, const SkyOpenness& sky) {
    Vector3f sum = Vector3f::Zero();
    // The ground is not the surface: background next to a shape keeps clear
    // of the shape's own openness.
    const bool center_is_ground = hits_[PixelNumber(x, y)].face < 0;
    for (int i = 0; i < kSub * kSub; ++i) {
      const int column = i % kSub;
      const int row = i / kSub;
      const float px =
          static_cast<float>(x) + (static_cast<float>(column) + 0.5F) / kSub;
      const float py =
          static_cast<float>(y) + (static_cast<float>(row) + 0.5F) / kSub;
      const RayHit hit = scene_.Look(px, py);
      const bool same = (hit.face < 0) == center_is_ground;
      sum += Shade(hit, px, py, same ? sky.At(x, y) : 0.8F);
      subpixels_.Set(x, y, i, {LineKey(hit), hit.z});
    }
    return sum / (kSub * kSub);
  }

  std::span<const RgbColor> face_colors_;
  const RayScene& scene_;
  const RenderOptions& options_;
  SurfaceShader shader_;
  std::optional<GroundPlane> ground_;
  std::vector<RayHit> hits_;
  SubpixelGrid subpixels_;
};

}  // namespace

absl::StatusOr<Image> RenderMesh(const TriangleMesh& mesh,
                                 std::span<const RgbColor> face_colors,
                                 const RenderOptions& options) {
  ARGMESH_RETURN_IF_ERROR(CheckOptions(options));
  ARGMESH_RETURN_IF_ERROR(CheckMesh(mesh));
  if (face_colors.size() != static_cast<size_t>(mesh.num_faces())) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "%d colours for %d faces", face_colors.size(), mesh.num_faces()));
  }
  if (mesh.num_faces() == 0) {
    return Image(options.width, options.height, options.background);
  }
  const View view = FitView(mesh, options.width, options.height, options.view);
  ARGMESH_ASSIGN_OR_RETURN(
      const RayScene scene,
      RayScene::Create(mesh, view, options.width, options.height));
  return Renderer(mesh, face_colors, scene, view, options).Render();
}

absl::StatusOr<Image> RenderMesh(const TriangleMesh& mesh, RgbColor color,
                                 const RenderOptions& options) {
  const std::vector<RgbColor> colors(static_cast<size_t>(mesh.num_faces()),
                                     color);
  return RenderMesh(mesh, colors, options);
}

}  // namespace argmesh
