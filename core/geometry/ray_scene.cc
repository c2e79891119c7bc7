#include "core/geometry/ray_scene.h"

#include <embree3/rtcore.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"

namespace argmesh {
namespace {

// One for the process, never released: making one costs more than building a
// scene. Its own thread count of 1 keeps building on the calling thread.
RTCDevice SharedDevice() {
  static const RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
  return device;
}

// Refuses the faces that the ray enters through.
void KeepExits(const RTCFilterFunctionNArguments* args) {
  for (unsigned int i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    const float along = RTCRayN_dir_x(args->ray, args->N, i) *
                            RTCHitN_Ng_x(args->hit, args->N, i) +
                        RTCRayN_dir_y(args->ray, args->N, i) *
                            RTCHitN_Ng_y(args->hit, args->N, i) +
                        RTCRayN_dir_z(args->ray, args->N, i) *
                            RTCHitN_Ng_z(args->hit, args->N, i);
    if (!(along > 0)) args->valid[i] = 0;
  }
}

absl::Status DeviceError(RTCError error) {
  return absl::InternalError(
      absl::StrFormat("ray tracer: error %d", static_cast<int>(error)));
}

// False when the buffers could not be allocated.
bool FillGeometry(RTCGeometry geometry, const TriangleMesh& mesh) {
  auto* const positions = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
      static_cast<size_t>(mesh.num_vertices())));
  auto* const corners = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
      3 * sizeof(uint32_t), static_cast<size_t>(mesh.num_faces())));
  if (positions == nullptr || corners == nullptr) return false;
  for (Eigen::Index i = 0; i < mesh.V.size(); ++i) {
    positions[i] = static_cast<float>(mesh.V.data()[i]);
  }
  for (Eigen::Index i = 0; i < mesh.F.size(); ++i) {
    corners[i] = static_cast<uint32_t>(mesh.F.data()[i]);
  }
  return true;
}

void SetRay(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
            float min_distance, RTCRay& ray) {
  ray.org_x = origin.x();
  ray.org_y = origin.y();
  ray.org_z = origin.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tnear = min_distance;
  ray.tfar = std::numeric_limits<float>::infinity();
  ray.mask = std::numeric_limits<unsigned int>::max();
}

}  // namespace

struct RayScene::Scene {
  explicit Scene(RTCScene scene) : handle(scene) {}
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  ~Scene() { rtcReleaseScene(handle); }

  RTCScene handle;
};

RayScene::RayScene(std::unique_ptr<Scene> scene) : scene_(std::move(scene)) {}
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;
RayScene::~RayScene() = default;

absl::StatusOr<RayScene> RayScene::Create(const TriangleMesh& mesh) {
  RTCDevice device = SharedDevice();
  if (device == nullptr) return DeviceError(rtcGetDeviceError(nullptr));
  RTCScene handle = rtcNewScene(device);
  if (handle == nullptr) return DeviceError(rtcGetDeviceError(device));
  auto scene = std::make_unique<Scene>(handle);
  rtcSetSceneFlags(handle, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(handle, RTC_BUILD_QUALITY_MEDIUM);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  if (geometry == nullptr) return DeviceError(rtcGetDeviceError(device));
  const bool filled = FillGeometry(geometry, mesh);
  if (filled) {
    rtcSetGeometryIntersectFilterFunction(geometry, KeepExits);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(handle, geometry);
  }
  rtcReleaseGeometry(geometry);
  if (!filled) return DeviceError(rtcGetDeviceError(device));
  rtcCommitScene(handle);
  if (const RTCError error = rtcGetDeviceError(device);
      error != RTC_ERROR_NONE) {
    return DeviceError(error);
  }
  return RayScene(std::move(scene));
}

std::optional<float> RayScene::FindExit(const Eigen::Vector3f& origin,
                                        const Eigen::Vector3f& direction,
                                        float min_distance) const {
  RTCRayHit ray{};
  SetRay(origin, direction, min_distance, ray.ray);
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_->handle, &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return ray.ray.tfar;
}

bool RayScene::IsOccluded(const Eigen::Vector3f& origin,
                          const Eigen::Vector3f& direction) const {
  RTCRay ray{};
  SetRay(origin, direction, 0, ray);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_->handle, &context, &ray);
  return ray.tfar < 0;  // so the ray tracer marks a hit
}

}  // namespace argmesh
