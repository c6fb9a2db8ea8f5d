#include "reference/ray_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lightwell/error.h"
#include "reference/embree.h"

namespace lightwell {

struct RayTracer::Handles {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  ~Handles() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

namespace {

constexpr unsigned kOpaqueGeometry = 0;
constexpr unsigned kMaskedGeometry = 1;

// Embree's filter function: rejects hits where an alpha mask cuts the triangle out.
void reject_cut_out(const RTCFilterFunctionNArguments* arguments) {
  const FlatScene& flat = *static_cast<const FlatScene*>(arguments->geometryUserPtr);
  for (unsigned i = 0; i < arguments->N; ++i) {
    if (arguments->valid[i] != -1) continue;
    const std::size_t triangle = flat.opaque_count + RTCHitN_primID(arguments->hit, arguments->N, i);
    const float u = RTCHitN_u(arguments->hit, arguments->N, i);
    const float v = RTCHitN_v(arguments->hit, arguments->N, i);
    const float alpha = flat.color(triangle, u, v).a;
    if (is_cut_out(*flat.scene, flat.material(triangle), flat.texcoords(triangle, u, v), alpha))
      arguments->valid[i] = 0;
  }
}

void check(RTCDevice device, const std::string& what) {
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE) throw InputError("Embree", what + ": error " + std::to_string(error));
}

void attach_triangles(RTCDevice device, RTCScene scene, const FlatScene& flat, unsigned id, std::size_t first,
                      std::size_t count) {
  if (count == 0) return;
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, flat.vertices.data(), 0,
                             sizeof(FlatVertex), flat.vertices.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, flat.triangles.data() + first, 0,
                             sizeof(FlatTriangle), count);
  if (id == kMaskedGeometry) {
    rtcSetGeometryUserData(geometry, const_cast<FlatScene*>(&flat));
    rtcSetGeometryIntersectFilterFunction(geometry, reject_cut_out);
    rtcSetGeometryOccludedFilterFunction(geometry, reject_cut_out);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, id);
  rtcReleaseGeometry(geometry);
}

void fill(RTCRay& ray, const glm::vec3& origin, const glm::vec3& direction, float t_min, float t_max) {
  ray.org_x = origin.x;
  ray.org_y = origin.y;
  ray.org_z = origin.z;
  ray.dir_x = direction.x;
  ray.dir_y = direction.y;
  ray.dir_z = direction.z;
  ray.tnear = t_min;
  ray.tfar = t_max;
  ray.time = 0.0f;
  ray.mask = ~0u;
  ray.id = 0;
  ray.flags = 0;
}

// The interpolated normal on the side of `geometric_normal`, which also replaces it where it vanishes.
glm::vec3 shading_normal(const FlatScene& flat, std::size_t triangle, float u, float v,
                         const glm::vec3& geometric_normal) {
  const glm::vec3 normal = (1.0f - u - v) * flat.corner(triangle, 0).normal + u * flat.corner(triangle, 1).normal +
                           v * flat.corner(triangle, 2).normal;
  const float length = glm::length(normal);
  if (!(length > 1e-6f)) return geometric_normal;
  return normal * ((glm::dot(normal, geometric_normal) < 0.0f ? -1.0f : 1.0f) / length);
}

Surface make_surface(const FlatScene& flat, std::size_t triangle, float u, float v, const glm::vec3& direction) {
  Surface surface;
  surface.triangle = triangle;
  // From the corners rather than along the ray, so that the error does not grow with the ray's length.
  surface.position = flat.position(triangle, u, v);
  surface.clearance = clearance_of(flat, triangle);
  const glm::vec3 front = glm::normalize(flat.area_normal(triangle));
  const bool seen_from_front = glm::dot(front, direction) < 0.0f;
  surface.geometric_normal = seen_from_front ? front : -front;
  surface.shading_normal = shading_normal(flat, triangle, u, v, surface.geometric_normal);
  const Material& material = flat.material(triangle);
  const TexcoordSets texcoords = flat.texcoords(triangle, u, v);
  surface.albedo = glm::vec3{base_color(*flat.scene, material, texcoords) * flat.color(triangle, u, v)};
  if (seen_from_front || material.double_sided) surface.emission = emitted_radiance(*flat.scene, material, texcoords);
  return surface;
}

}  // namespace

float clearance_of(const FlatScene& flat, std::size_t triangle) {
  // 32 units in the last place of the largest coordinate: Embree's robust mode subtracts corners from the ray's origin,
  // which costs a few of them.
  constexpr float kRelativeClearance = 32.0f * 0x1p-24f;
  const glm::vec3 largest =
      glm::max(glm::max(glm::abs(flat.corner(triangle, 0).position), glm::abs(flat.corner(triangle, 1).position)),
               glm::abs(flat.corner(triangle, 2).position));
  return kRelativeClearance * std::max({largest.x, largest.y, largest.z});
}

RayTracer::RayTracer(const FlatScene& flat) : flat_(flat), handles_(std::make_unique<Handles>()) {
  handles_->device = rtcNewDevice(nullptr);
  check(handles_->device, "cannot start");
  handles_->scene = rtcNewScene(handles_->device);
  rtcSetSceneFlags(handles_->scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(handles_->scene, RTC_BUILD_QUALITY_HIGH);
  attach_triangles(handles_->device, handles_->scene, flat, kOpaqueGeometry, 0, flat.opaque_count);
  attach_triangles(handles_->device, handles_->scene, flat, kMaskedGeometry, flat.opaque_count,
                   flat.triangles.size() - flat.opaque_count);
  rtcCommitScene(handles_->scene);
  check(handles_->device, "cannot build the scene");
}

RayTracer::~RayTracer() = default;

std::optional<TriangleHit> RayTracer::closest_triangle(const Ray& ray) const {
  RTCRayHit ray_hit;
  fill(ray_hit.ray, ray.origin, ray.direction, ray.t_min, std::numeric_limits<float>::infinity());
  ray_hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray_hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  embree_intersect(handles_->scene, ray_hit);
  const RTCHit& hit = ray_hit.hit;
  if (hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const std::size_t triangle = hit.primID + (hit.geomID == kMaskedGeometry ? flat_.opaque_count : 0);
  return TriangleHit{triangle, ray_hit.ray.tfar, hit.u, hit.v};
}

std::optional<Surface> RayTracer::closest(const Ray& ray) const {
  const std::optional<TriangleHit> hit = closest_triangle(ray);
  if (!hit) return std::nullopt;
  return make_surface(flat_, hit->triangle, hit->u, hit->v, ray.direction);
}

bool RayTracer::is_blocked(const glm::vec3& origin, const glm::vec3& direction, float t_max) const {
  RTCRay ray;
  fill(ray, origin, direction, 0.0f, t_max);
  embree_occluded(handles_->scene, ray);
  return ray.tfar < 0.0f;
}

}  // namespace lightwell
