// Splats that a view sees vote for the stratum where their path started.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_paths/light_path_guide.h"
#include "shaders/camera.h"
#include "techniques/photon_splatting/photon_types.h"
#include "techniques/photon_splatting/splat_storage.glsl"

layout(local_size_x = 64) in;
LW_SPLATS_READ(0, 0)
layout(set = 0, binding = 1) readonly buffer SplatCountBuffer { uint data[]; } splat_counts;
layout(set = 0, binding = 2) uniform Camera { LW_GPU_CAMERA(LW_DECLARE_MEMBER) } camera;
layout(set = 0, binding = 3) uniform sampler2D position;  // w: 0 where there is no surface
layout(set = 0, binding = 4) readonly buffer StratumBuffer { uint data[]; } strata;  // of splats
layout(set = 0, binding = 5) buffer CountBuffer { uvec2 data[]; } counts;

#include "shaders/hemisphere.glsl"
#include "shaders/linear_dispatch.glsl"

// Whether what the view shows at `place` is no farther from it than `near`, m.
bool is_seen(vec3 place, float near) {
  vec4 clip = camera.view_projection * vec4(place, 1.0);
  if (clip.w < max(camera.znear, 1e-30)) return false;
  vec2 pixel = (clip.xy / clip.w * 0.5 + 0.5) * vec2(camera.size);
  if (any(lessThan(pixel, vec2(0.0))) || any(greaterThanEqual(pixel, vec2(camera.size)))) return false;
  vec4 surface = texelFetch(position, ivec2(pixel), 0);
  return surface.w > 0.0 && distance(surface.xyz, place) < near;
}

void main() {
  uint index = linear_invocation();
  if (index >= splat_counts.data[kSplatsInUse]) return;
  Splat splat = splat_at(index);
  uint stratum = strata.data[index];
  if (splat.flux == vec3(0.0) || stratum == kNoStratum) return;
  // Its middle, and places about it on its surface.
  mat3 surface = frame_about(unpack_unit_vector(splat.normal));
  vec3 side = 0.7 * splat.half_width * surface[0];
  vec3 other = 0.7 * splat.half_width * surface[1];
  float near = 0.5 * splat.half_width;
  bool seen = is_seen(splat.center, near) || is_seen(splat.center + side, near) ||
              is_seen(splat.center - side, near) || is_seen(splat.center + other, near) ||
              is_seen(splat.center - other, near);
  if (seen) atomicAdd(counts.data[stratum].y, 1);
}
