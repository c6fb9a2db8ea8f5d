// Which texels of last frame showed a pixel's surface, and the record by which the next frame will find this frame's.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/reprojection/reproject_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D position;
layout(set = 0, binding = 1) uniform sampler2D normal;
layout(set = 0, binding = 2) uniform sampler2D emission;  // w: material
layout(set = 0, binding = 3) uniform sampler2D face;
layout(set = 0, binding = 4) uniform sampler2D motion;
layout(set = 0, binding = 5) uniform usampler2D last_surface;
layout(set = 0, binding = 6, r32ui) writeonly uniform uimage2D reprojection;
layout(set = 0, binding = 7, rgba32ui) writeonly uniform uimage2D surface;

#include "passes/reprojection/history_taps.glsl"
#include "passes/reprojection/surface_record.glsl"
#include "shaders/software_drivers.glsl"

// True if a texel of last frame showed the surface `expected`.
bool shows(ivec2 texel, SurfaceRecord expected, float tolerance) {
  const float kLeastCosine = 0.9;
  if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(params.size)))) return false;
  SurfaceRecord there = unpack_surface(texelFetch(last_surface, texel, 0));
  return there.distance > 0.0 && there.material == expected.material &&
         dot(there.normal, expected.normal) >= kLeastCosine &&
         abs(there.distance - expected.distance) <= tolerance * expected.distance;
}

// The part by which a plane's distance may change over 1.5 pixels, and a little for rounding and curvature.
float distance_tolerance(vec4 place, vec3 face_normal) {
  float slope = params.pixel_tangent * place.w / max(abs(dot(face_normal, place.xyz - params.camera_position)), 1e-30);
  return 0.005 + min(1.5 * slope, 0.2);
}

uint find_valid_taps(LastPlace place, SurfaceRecord expected, float tolerance) {
  const float kLeastWeight = 0.05;
  uint valid = 0;
  float weight = 0.0;
  for (uint i = 0; i < (place.still ? 1 : kBilinearTaps); ++i) {
    HistoryTap tap = bilinear_tap(place, i);
    if (!shows(tap.texel, expected, tolerance)) continue;
    valid |= 1u << i;
    weight += tap.weight;
  }
  // At edges a neighbour may know the surface: the camera's jitter shows now one, now the other.
  bool borrows = weight < kLeastWeight;
  for (uint i = 0; i < LW_ROUNDS_IF(borrows, kNeighbourTaps); ++i)
    if (shows(neighbour_tap(place, i).texel, expected, tolerance)) valid |= 1u << (kBilinearTaps + i);
  return valid | (borrows ? kBorrowedBit : 0u);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(params.size)))) return;
  vec4 place = texelFetch(position, pixel, 0);
  vec4 face_normal_ratio = texelFetch(face, pixel, 0);
  SurfaceRecord record = SurfaceRecord(place.w, texelFetch(normal, pixel, 0).xyz,
                                       uint(texelFetch(emission, pixel, 0).w));
  uint taps = 0;
  if (params.has_history != 0 && place.w > 0.0) {
    SurfaceRecord expected = record;
    expected.distance = place.w * face_normal_ratio.z;
    taps = find_valid_taps(last_place(pixel, texelFetch(motion, pixel, 0).xy), expected,
                           distance_tolerance(place, from_octahedron(face_normal_ratio.xy)));
  }
  imageStore(reprojection, pixel, uvec4(taps));
  imageStore(surface, pixel, place.w > 0.0 ? pack_surface(record) : uvec4(0));
}
