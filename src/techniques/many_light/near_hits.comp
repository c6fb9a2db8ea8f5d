// Short cosine-distributed rays: what the clamped geometry term G min(1, r^2 / B) leaves out of the light,
//   the integral of L cos (1 - r^2 / B)+, is pi L(y) (1 - r^2 / B)+ in the mean over them,
// y where the ray ends on a surface no farther than sqrt(B) away, B that of light points at y (after Kollig and Keller
// 2004). Gives y as a receiver,
// and by what its irradiance counts: albedo (1 - r^2 / B).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/many_light/many_light_types.h"

layout(local_size_x = 8, local_size_y = 8) in;
LW_PUSH_CONSTANTS(NearParams, LW_NEAR_PARAMS)
layout(set = 0, binding = 0) uniform sampler2D position;
layout(set = 0, binding = 1) uniform sampler2D normal;
layout(set = 0, binding = 2) uniform sampler2D face;
layout(set = 0, binding = 3, rgba32f) writeonly uniform image2D near_position;
layout(set = 0, binding = 4, rgba16f) writeonly uniform image2D near_normal;
layout(set = 0, binding = 5, rgba16f) writeonly uniform image2D near_face;
layout(set = 0, binding = 6, rgba16f) writeonly uniform image2D factor;

#include "shaders/trace.glsl"

#include "passes/light_clusters/light_clamp.glsl"
#include "shaders/hemisphere.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/random.glsl"
#include "shaders/receiver.glsl"

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, params.size))) return;
  vec4 place = texelFetch(position, ivec2(pixel), 0);
  Receiver receiver = make_receiver(place, texelFetch(normal, ivec2(pixel), 0).xyz,
                                    from_octahedron(texelFetch(face, ivec2(pixel), 0).xy), params.clearance);
  vec2 random = stratified_point(pixel, params.sample_index, params.sequence);
  vec3 direction = cosine_direction(frame_about(receiver.normal), disk_point(random));
  bool leaves = place.w > 0.0 && cosine_above(receiver, direction) > 0.0;
  RayHit hit = RayHit(0.0, kNoTriangle, vec2(0.0));
  // A ray that is not wanted ends where it begins.
  // B grows by clamp_part at most along the way.
  float reach = min(least_distance(receiver.position) / max(1.0 - params.clamp_part, 0.1),
                    params.clamp_part * params.clamp_farthest);
  hit = trace_closest(Ray(receiver.start, 0.0, direction, leaves ? reach : 0.0));
  vec4 near = vec4(0.0);
  vec3 n = vec3(0.0, 0.0, 1.0);
  vec3 f = n;
  vec3 counts = vec3(0.0);
  if (leaves && hit.triangle != kNoTriangle) {
    Surface surface = surface_at(hit, direction);
    float part = hit.t / least_distance(surface.position);
    near = vec4(surface.position, 1.0);
    n = surface.normal;
    f = surface.face_normal;
    counts = surface.albedo * max(0.0, 1.0 - part * part);
  }
  imageStore(near_position, ivec2(pixel), near);
  imageStore(near_normal, ivec2(pixel), vec4(n, 0.0));
  imageStore(near_face, ivec2(pixel), vec4(to_octahedron(f), 0.0, 0.0));
  imageStore(factor, ivec2(pixel), vec4(counts, 1.0));
}
