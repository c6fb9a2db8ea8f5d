// The one front door of ray tracing: any hit and closest hit against the scene as it is this frame, alpha masks
// respected. Reads the scene's set 1 and the hierarchy's set 2 (trace_compute() of passes/trace/tracer.h binds both); a
// kernel that includes this file by itself is compiled twice, for our own hierarchy and for ray queries. Both give the same answer,
// but for rounding at edges and at the ends of a ray.
#ifndef LIGHTWELL_TRACE_GLSL
#define LIGHTWELL_TRACE_GLSL

#include "passes/gpu_scene/gpu_scene_types.h"


#include "shaders/geometry.glsl"
#include "shaders/material.glsl"
#include "shaders/alpha_mask.glsl"
#include "shaders/ray_start.glsl"

// Triangles from this one on may have holes (GpuScene::Frame::opaque_triangle_count); 0xffffffff where none has, which
// spares the device the code.
layout(constant_id = 11) const uint kOpaqueTriangles = 0xffffffffu;

// Points origin + t * direction with t_min <= t <= t_max, t_min not negative. `direction` may have any length but 0.
struct Ray {
  vec3 origin;
  float t_min;
  vec3 direction;
  float t_max;
};

const uint kNoTriangle = 0xffffffffu;
const float kFarAway = 1e30;  // t_max of rays without an end

struct RayHit {
  float t;            // in units of the ray's direction
  uint triangle;      // of the scene, or kNoTriangle
  vec2 barycentrics;  // weights of the triangle's second and third corner
};

// True if is_cut_out() has to be asked about this triangle. Ask outside of loops
// (shaders/software_drivers.glsl).
bool may_be_cut_out(uint triangle) { return kOpaqueTriangles != kNoTriangle && triangle >= kOpaqueTriangles; }

// True where the alpha of a triangle's material cuts a hole at this point.
bool is_cut_out(uint triangle, vec2 barycentrics) {
  Triangle t = load_triangle(triangle);
  GpuMaterial material = scene_material(vertex_material(t.v[0]));
  return is_hole(material, mask_alpha(material, triangle_color(t, barycentrics), triangle_uv(t, barycentrics)));
}

// Both files define
//   bool is_blocked(Ray ray);        // whether anything is on the ray
//   RayHit trace_closest(Ray ray);   // the first thing on it; of several at the same t, our own hierarchy gives the
//                                    // lowest triangle, a ray query any of them
#if LW_RAY_QUERY
#include "shaders/trace_ray_query.glsl"
#else
#include "shaders/trace_bvh.glsl"
#endif

// What a ray met, as something that light can leave again.
struct Surface {
  vec3 position;
  vec3 face_normal;  // unit, towards the ray
  vec3 normal;       // unit, interpolated, on the same side
  vec3 albedo;       // with which caches of light reflect
  vec3 emission;     // W/(sr m^2), towards the ray
  uint material;
};

Surface surface_at(RayHit hit, vec3 direction) {
  Triangle t = load_triangle(hit.triangle);
  vec3 weights = corner_weights(hit.barycentrics);
  Surface s;
  s.position = weights.x * vertex_position(t.v[0]) + weights.y * vertex_position(t.v[1]) +
               weights.z * vertex_position(t.v[2]);
  vec3 front_side = front_normal(t);
  bool front = dot(front_side, direction) < 0.0;
  s.face_normal = normalize(front ? front_side : -front_side);
  vec3 n = weights.x * vertex_normal(t.v[0]) + weights.y * vertex_normal(t.v[1]) + weights.z * vertex_normal(t.v[2]);
  float n_length = length(n);
  n = n_length > 1e-6 ? n / n_length : s.face_normal;
  s.normal = dot(n, s.face_normal) < 0.0 ? -n : n;
  vec4 uv = triangle_uv(t, hit.barycentrics);
  s.material = vertex_material(t.v[0]);
  GpuMaterial material = scene_material(s.material);
  s.albedo = cache_albedo(material, base_color(material, triangle_color(t, hit.barycentrics), uv, vec4(0.0), vec4(0.0)));
  s.emission = emitted_radiance(material, uv, vec4(0.0), vec4(0.0), front);
  return s;
}

#endif
