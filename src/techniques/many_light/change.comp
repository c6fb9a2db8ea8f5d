// Whether the light of a pixel has changed: what its last ray brought then and what it would bring now. The light paths of
// last frame are followed once more in this frame's scene, so the same point, in the same place of the sequence, tells
// the two apart without any noise of sampling: where nothing has changed the difference is 0.
// One pixel in kChangeBlock^2 is asked.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_clusters/light_clusters_types.h"
#include "passes/noise_filter/light_change_types.h"
#include "shaders/light_point.h"
#include "techniques/many_light/many_light_types.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool kShadows = true;
LW_PUSH_CONSTANTS(ChangeParams, LW_CHANGE_PARAMS)
layout(set = 0, binding = 0) uniform sampler2D position;
layout(set = 0, binding = 1) uniform sampler2D normal;
layout(set = 0, binding = 2) uniform sampler2D face;
layout(set = 0, binding = 3) uniform sampler2D motion;
layout(set = 0, binding = 4) uniform usampler2D reprojection;
layout(set = 0, binding = 5) uniform usampler2D last_memory;
layout(set = 0, binding = 6) readonly buffer LastPointBuffer { LightPoint data[]; } last_points;
layout(set = 0, binding = 7) readonly buffer ReplayedPointBuffer { LightPoint data[]; } replayed_points;
layout(set = 0, binding = 8, rgba32f) writeonly uniform image2D change;  // difference, its square, the larger of both

#include "shaders/trace.glsl"

#include "passes/light_clusters/light_clamp.glsl"
#include "passes/reprojection/reprojection.glsl"
#include "shaders/light_point.glsl"
#include "shaders/luminance.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/receiver.glsl"

float light_of(Receiver receiver, LightPoint point) {
  float geometry = clamped_geometry(receiver.position, receiver.normal, point, least_distance_squared(point.position));
  return luminance(light_point_irradiance(point, geometry));
}

void main() {
  uvec2 block = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(block, params.block_count))) return;
  uvec2 pixel = pixel_of_turn(block, params.turn, params.size);
  vec4 place = texelFetch(position, ivec2(pixel), 0);
  Reprojection r = load_reprojection(ivec2(pixel));
  vec3 result = vec3(0.0);
  if (place.w > 0.0 && r.taps != 0) {
    Receiver receiver = make_receiver(place, texelFetch(normal, ivec2(pixel), 0).xyz,
                                      from_octahedron(texelFetch(face, ivec2(pixel), 0).xy), params.clearance);
    uvec4 memory = texelFetch(last_memory, history_tap(r.place, findLSB(r.taps)).texel, 0);
    uint index = memory.x == kNoChoice ? 0 : memory.x;
    float weight = memory.x == kNoChoice ? 0.0 : uintBitsToFloat(memory.y);
    LightPoint now = replayed_points.data[index];
    float before = memory.z != 0 ? weight * light_of(receiver, last_points.data[index]) : 0.0;
    float after = weight * light_of(receiver, now);
    if (kShadows && after > 0.0 && is_blocked(Ray(receiver.start, 0.0, now.position - receiver.start, 1.0))) after = 0.0;
    result = vec3(after - before, (after - before) * (after - before), max(after, before));
  }
  imageStore(change, ivec2(block), vec4(result, 0.0));
}
