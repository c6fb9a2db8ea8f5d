// The mean of sampled light over frames, each pixel's history fetched from where its surface was last frame.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/sampled_lights/accumulate_light_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D sampled;
layout(set = 0, binding = 1) uniform sampler2D position;
layout(set = 0, binding = 2) uniform sampler2D normal;
layout(set = 0, binding = 3) uniform sampler2D face;
layout(set = 0, binding = 4) uniform sampler2D motion;
layout(set = 0, binding = 5) uniform sampler2D last_light;  // w: frames in the mean
layout(set = 0, binding = 6) uniform usampler2D last_surface;
layout(set = 0, binding = 7, rgba32f) writeonly uniform image2D light;
layout(set = 0, binding = 8, rgba32ui) writeonly uniform uimage2D surface;

#include "passes/sampled_lights/surface_history.glsl"
#include "shaders/luminance.glsl"

struct History {
  vec4 light;
  float mean_square;
  float weight;
};

// Adds a texel of last frame's, if it shows the surface `here`, which was then `here.distance` away.
void add_texel(inout History history, ivec2 texel, float weight, SurfaceHistory here, float tolerance) {
  const float kLeastCosine = 0.9;
  if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(params.size)))) return;
  SurfaceHistory there = unpack_surface(texelFetch(last_surface, texel, 0));
  if (there.distance <= 0.0 || there.material != here.material || dot(there.normal, here.normal) < kLeastCosine ||
      abs(there.distance - here.distance) > tolerance * here.distance)
    return;
  history.light += weight * texelFetch(last_light, texel, 0);
  history.mean_square += weight * there.mean_square;
  history.weight += weight;
}

// The part by which a plane's distance may change over 1.5 pixels, and a little for rounding and curvature.
float distance_tolerance(vec4 place, vec3 face_normal) {
  float slope = params.pixel_tangent * place.w / max(abs(dot(face_normal, place.xyz - params.camera_position)), 1e-30);
  return 0.005 + min(1.5 * slope, 0.2);
}

History fetch_history(vec2 last_place, bool still, SurfaceHistory here, float tolerance) {
  History history = History(vec4(0.0), 0.0, 0.0);
  // Where nothing moved, the pixel itself: interpolating again and again would blur.
  vec2 corner = still ? floor(last_place) : floor(last_place - 0.5);
  vec2 part = still ? vec2(0.0) : last_place - 0.5 - corner;
  int taps = still ? 1 : 4;
  for (int i = 0; i < taps; ++i) {
    ivec2 step = ivec2(i & 1, i >> 1);
    vec2 weights = mix(1.0 - part, part, vec2(step));
    add_texel(history, ivec2(corner) + step, weights.x * weights.y, here, tolerance);
  }
  // At edges a neighbour may know the surface: the camera's jitter shows now one, now the other.
  int rounds = history.weight < 0.05 ? 9 : 0;
  for (int i = 0; i < rounds; ++i)
    add_texel(history, ivec2(floor(last_place)) + ivec2(i % 3, i / 3) - 1, 1.0, here, tolerance);
  // Their light is like this pixel's, but not the same.
  const float kMostBorrowed = 8.0;  // frames
  if (rounds > 0) history.light.w = min(history.light.w, kMostBorrowed * history.weight);
  return history;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(params.size)))) return;
  const float kStill = 1.0 / 16.0;         // pixels
  const float kMostInterpolated = 64.0;    // frames: errors of interpolation must fade
  vec4 place = texelFetch(position, pixel, 0);
  vec4 normal_material = texelFetch(normal, pixel, 0);
  vec4 face_normal_ratio = texelFetch(face, pixel, 0);
  vec2 moved = texelFetch(motion, pixel, 0).xy;
  vec3 value = texelFetch(sampled, pixel, 0).rgb;
  float square = luminance(value) * luminance(value);

  SurfaceHistory here = SurfaceHistory(place.w * face_normal_ratio.z, normal_material.xyz, uint(normal_material.w), 0.0);
  History history = History(vec4(0.0), 0.0, 0.0);
  bool still = all(lessThan(abs(moved), vec2(kStill)));
  if (params.fresh == 0 && place.w > 0.0) {
    history = fetch_history(vec2(pixel) + 0.5 - (still ? vec2(0.0) : moved), still, here,
                            distance_tolerance(place, from_octahedron(face_normal_ratio.xy)));
  }
  vec4 mean = history.weight > 0.0 ? history.light / history.weight : vec4(0.0);
  float mean_square = history.weight > 0.0 ? history.mean_square / history.weight : 0.0;
  float frames = min(mean.w, still ? params.most_frames : min(params.most_frames, kMostInterpolated));
  float weight = params.eagerness / (frames + params.eagerness);
  mean = vec4(mix(mean.rgb, value, weight), frames + 1.0);
  here.distance = place.w;
  here.mean_square = mix(mean_square, square, weight);
  imageStore(light, pixel, place.w > 0.0 ? mean : vec4(0.0));
  imageStore(surface, pixel, place.w > 0.0 ? pack_surface(here) : uvec4(0));
}
