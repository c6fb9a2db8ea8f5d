// The splats' shadow maps: a parallel ray for each texel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/photon_splatting/photon_params.h"
#include "techniques/photon_splatting/splat_storage.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kReceiverTest = true;
LW_SPLATS_READ(0, 0)
layout(set = 0, binding = 1) readonly buffer StartBuffer { PhotonStart data[]; } starts;
layout(set = 0, binding = 2) readonly buffer SplatCountBuffer { uint data[]; } splat_counts;
layout(set = 0, binding = 3, r32f) writeonly uniform image2D shadow_atlas;

#include "shaders/trace.glsl"

#include "shaders/light_point.glsl"
#include "shaders/linear_dispatch.glsl"
#include "techniques/photon_splatting/shadow_atlas.glsl"
#include "techniques/photon_splatting/splat_rules.glsl"

// Where along its ray, m from the plane at -reach, a texel's light leaves the surface that the bundle leaves; `across`:
// from the axis. A ray that begins farther back meets that surface, or what is behind it, first.
float begin_of(Splat splat, PhotonStart start, vec3 across) {
  vec3 normal = unpack_unit_vector(start.normal);
  float leaving = max(dot(normal, splat.direction), 1e-3);
  float clearance = 1e-3 * length(across) / leaving;  // more than what the normal's packing is off by
  float distance = dot(splat.center - start.position, splat.direction);
  float begin = splat.reach - distance - dot(across, normal) / leaving + clearance;
  return clamp(begin, 0.0, 2.0 * splat.reach);
}

// Whether what is met at `position` may be lit by a bundle that ends on the splat's surface: they are one, about.
bool is_accepted(Splat splat, uint triangle, vec3 position) {
  vec3 corner = scene_position(scene_index(3 * triangle));
  vec3 face = normalize(cross(scene_position(scene_index(3 * triangle + 1)) - corner,
                              scene_position(scene_index(3 * triangle + 2)) - corner));
  if (dot(face, splat.direction) > 0.0) face = -face;
  vec3 normal = unpack_unit_vector(splat.normal);
  return dot(face, normal) > kLeastLikeness &&
         abs(dot(position - splat.center, normal)) < kMostOff * splat.half_width;
}

void main() {
  uint texels = params.map_side * params.map_side;
  uint index = linear_invocation();
  uint map = index / texels;
  if (map >= splat_counts.data[kSplatsInUse]) return;
  Splat splat = splat_at(map);
  if (splat.flux == vec3(0.0)) return;
  ivec2 texel = ivec2(index % params.map_side, index % texels / params.map_side);
  vec3 middle = across_splat(splat, texel_place(texel, params.map_side));
  float begin = kReceiverTest ? begin_of(splat, starts.data[map], middle - splat.center) : 0.0;
  float end = 2.0 * splat.reach;
  vec3 origin = middle - splat.reach * splat.direction;
  RayHit hit = trace_closest(Ray(origin, begin, splat.direction, end));
  float depth = hit.triangle == kNoTriangle ? end : hit.t;
  if (kReceiverTest) {
    if (hit.triangle == kNoTriangle) depth = 0.0;
    else if (!is_accepted(splat, hit.triangle, origin + depth * splat.direction)) depth = 0.0;
  }
  imageStore(shadow_atlas, map_corner(map, params.maps_per_row, params.map_side) + texel, vec4(depth));
}
