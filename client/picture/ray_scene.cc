#include "client/picture/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"

namespace argmesh {

struct RayScene::Impl {
  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  Eigen::Vector3f ToPicture(const Eigen::Vector3d& p) const {
    return (axes * (p - center) + middle).cast<float>();
  }
  absl::Status AddMesh(const TriangleMesh& mesh);

  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  // Rows are the picture's axes, in pixels per unit.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  float near_z = 0;  // beyond the nearest point
};

namespace {

struct Float3 {
  float x, y, z;
};
struct Index3 {
  unsigned a, b, c;
};

}  // namespace

RayScene::RayScene(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

absl::Status RayScene::Impl::AddMesh(const TriangleMesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<Float3*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Float3),
      static_cast<size_t>(mesh.num_vertices())));
  auto* faces = static_cast<Index3*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Index3),
      static_cast<size_t>(mesh.num_faces())));
  if (vertices == nullptr || faces == nullptr) {
    rtcReleaseGeometry(geometry);
    return absl::ResourceExhaustedError(
        absl::StrFormat("ray tracer: no memory for %d vertices and %d faces",
                        mesh.num_vertices(), mesh.num_faces()));
  }
  for (int v = 0; v < mesh.num_vertices(); ++v) {
    const Eigen::Vector3f p = ToPicture(mesh.vertex(v));
    vertices[v] = {p.x(), p.y(), p.z()};
    near_z = std::max(near_z, p.z() + 1);
  }
  for (int f = 0; f < mesh.num_faces(); ++f) {
    faces[f] = {static_cast<unsigned>(mesh.F(f, 0)),
                static_cast<unsigned>(mesh.F(f, 1)),
                static_cast<unsigned>(mesh.F(f, 2))};
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  return absl::OkStatus();
}

absl::StatusOr<RayScene> RayScene::Create(const TriangleMesh& mesh,
                                          const View& view, int width,
                                          int height) {
  auto impl = std::make_unique<Impl>();
  impl->axes << view.right.transpose(), -view.up.transpose(),
      view.toward.transpose();
  impl->axes *= view.pixels_per_unit;
  impl->center = view.center;
  impl->middle = Eigen::Vector3d(0.5 * width, 0.5 * height, 0);
  // One thread builds the tree, so that it is the same everywhere.
  impl->device = rtcNewDevice("threads=1");
  if (impl->device == nullptr) {
    return absl::ResourceExhaustedError("ray tracer: no device");
  }
  impl->scene = rtcNewScene(impl->device);
  rtcSetSceneFlags(impl->scene, RTC_SCENE_FLAG_ROBUST);
  ARGMESH_RETURN_IF_ERROR(impl->AddMesh(mesh));
  rtcCommitScene(impl->scene);
  if (rtcGetDeviceError(impl->device) != RTC_ERROR_NONE) {
    return absl::ResourceExhaustedError("ray tracer: building the tree failed");
  }
  return RayScene(std::move(impl));
}

RayHit RayScene::Look(float x, float y) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  RTCRayHit query = {};
  query.ray.org_x = x;
  query.ray.org_y = y;
  query.ray.org_z = impl_->near_z;
  query.ray.dir_z = -1;
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.mask = ~0U;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return {.face = static_cast<int32_t>(query.hit.primID),
          .z = impl_->near_z - query.ray.tfar,
          .u = query.hit.u,
          .v = query.hit.v};
}

bool RayScene::Occluded(const Eigen::Vector3f& origin,
                        const Eigen::Vector3f& direction, float reach) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = {};
  ray.org_x = origin.x();
  ray.org_y = origin.y();
  ray.org_z = origin.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tfar = reach;
  ray.mask = ~0U;
  rtcOccluded1(impl_->scene, &context, &ray);
  return ray.tfar < 0;
}

Eigen::Vector3f RayScene::ToPicture(const Eigen::Vector3d& p) const {
  return impl_->ToPicture(p);
}

Eigen::Vector3f RayScene::DirectionToPicture(const Eigen::Vector3d& d) const {
  return (impl_->axes * d).normalized().cast<float>();
}

}  // namespace argmesh
