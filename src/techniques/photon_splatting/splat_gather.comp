// Sums up what the splats of a tile's list bring to its pixels, each in registers, in the order of the list.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/camera.h"
#include "techniques/photon_splatting/splat_storage.glsl"
#include "techniques/photon_splatting/splat_view_types.h"

layout(local_size_x = 64) in;  // 16x16 samples: one tile or several
LW_PUSH_CONSTANTS(SplatGatherParams, LW_SPLAT_GATHER_PARAMS)
layout(constant_id = 0) const uint kEstimate = kEstimateDensity;
layout(constant_id = 1) const uint kKernel = kSplatBox;
layout(constant_id = 2) const uint kShow = kShowLight;
layout(constant_id = 3) const uint kTile = kSplatTile;  // side, samples
LW_SPLATS_READ(0, 0)
layout(set = 0, binding = 1) readonly buffer RangeBuffer { uvec2 data[]; } ranges;
layout(set = 0, binding = 2) readonly buffer EntryBuffer { uint data[]; } entries;
layout(set = 0, binding = 3) readonly buffer TotalBuffer { uvec2 total; } totals;  // y: one entry stands for 2^y
layout(set = 0, binding = 4) uniform sampler2D position;
layout(set = 0, binding = 5) uniform sampler2D normal;
layout(set = 0, binding = 6) uniform sampler2D face;
layout(set = 0, binding = 7) uniform sampler2D shadow_atlas;
layout(set = 0, binding = 8, rgba32f) writeonly uniform image2D gathered;  // a texel a sample

#include "shaders/light_point.glsl"
#include "techniques/photon_splatting/splat_samples.glsl"
#include "techniques/photon_splatting/splat_light.glsl"

const uint kStep = kTile / 2;              // between an invocation's four samples
const uint kTileRow = kSplatTile / kTile;  // of a workgroup

// An invocation's samples are in one tile, so that it looks at each splat once.
uvec2 tile() {
  uint i = gl_LocalInvocationID.x / (kStep * kStep);
  return gl_WorkGroupID.xy * kTileRow + uvec2(i % kTileRow, i / kTileRow);
}

ivec2 sample_of(int i) {
  uint k = gl_LocalInvocationID.x % (kStep * kStep);
  return ivec2(tile() * kTile + uvec2(k % kStep, k / kStep) + kStep * uvec2(i & 1, i >> 1));
}

// The color of 0, 200, 400, 600 splats is blue, green, red, white.
vec3 heat(float overlap) {
  vec3 steps = clamp(overlap / 200.0 - vec3(0.0, 1.0, 2.0), 0.0, 1.0);
  return vec3(steps.y, steps.x - steps.y + steps.z, 1.0 - steps.x + steps.z);
}

vec4 shown(SplatRay ray, SplatPixel pixel) {
  vec4 light = light_of(ray, pixel);
  if (kShow == kShowOverlap) return vec4(light.w > 0.0 ? 1.0 : 0.0);
  if (kShow == kShowCenters) {
    bool near = distance(pixel.place.xyz, ray.center) < params.dot_tangent * pixel.place.w;
    return vec4(near ? ray.light / max(max(ray.light.r, ray.light.g), ray.light.b) : vec3(0.0), 0.0);
  }
  return light;
}

void main() {
  SplatPixel pixels[4];
  vec4 sums[4];
  for (int i = 0; i < 4; ++i) {
    ivec2 place = pixel_of_sample(sample_of(i));
    pixels[i] = SplatPixel(texelFetch(position, place, 0), texelFetch(normal, place, 0).xyz,
                           from_octahedron(texelFetch(face, place, 0).xy));
    sums[i] = vec4(0.0);
  }
  uvec2 tiles = (uvec2(sample_count()) - 1) / kTile + 1;
  uvec2 range = all(lessThan(tile(), tiles)) ? ranges.data[tile().y * tiles.x + tile().x] : uvec2(0);
  for (uint k = range.x; k < range.y; ++k) {
    SplatRay ray = make_splat_ray(splat_at(entries.data[k]));
    for (int i = 0; i < 4; ++i) sums[i] += shown(ray, pixels[i]);
  }
  // Lists that were thinned stand for longer ones.
  float stands_for = exp2(float(totals.total.y));
  for (int i = 0; i < 4; ++i) {
    ivec2 place = sample_of(i);
    if (any(greaterThanEqual(place, sample_count()))) continue;
    vec4 sum = stands_for * sums[i];
    if (kShow == kShowOverlap) sum.xyz = heat(sum.w);
    if (kShow == kShowCenters) sum.xyz = min(sum.xyz, vec3(1.0));
    imageStore(gathered, place, pixels[i].place.w > 0.0 ? sum : vec4(0.0));
  }
}
