// A splat for each bundle of light points: with the flux of all, from the place of one.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/light_point.h"
#include "shaders/paged_buffer.glsl"
#include "techniques/photon_splatting/photon_params.h"
#include "techniques/photon_splatting/splat_storage.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kNearestToMean = false;  // else any
LW_PAGED_READ(0, 0, LightPoint, points)
layout(set = 0, binding = 1) readonly buffer AreaBuffer { float data[]; } areas;
layout(set = 0, binding = 2) readonly buffer SortedBuffer { uvec2 data[]; } sorted;
layout(set = 0, binding = 3) readonly buffer BeginBuffer { uint data[]; } begins;
layout(set = 0, binding = 4) readonly buffer PointCountBuffer { uint data[]; } point_counts;
layout(set = 0, binding = 5) readonly buffer SplatCountBuffer { uint data[]; } splat_counts;
layout(set = 0, binding = 6) readonly buffer SobolBuffer { uint data[]; } sobol_matrices;
LW_SPLATS_WRITE(0, 7)
layout(set = 0, binding = 8) writeonly buffer StartBuffer { PhotonStart data[]; } starts;

#include "shaders/trace.glsl"

#include "shaders/linear_dispatch.glsl"
#include "techniques/photon_splatting/splat_make.glsl"

LightPoint bundled_point(uint i) { return points_at(sorted.data[i].y); }

// Of the light points [begin, end), the one nearest to `mean`.
uint nearest_to(vec3 mean, uint begin, uint end) {
  uint nearest = begin;
  float least = 1e38;
  for (uint i = begin; i < end; ++i) {
    vec3 offset = bundled_point(i).position - mean;
    float squared = dot(offset, offset);
    if (squared < least) {
      least = squared;
      nearest = i;
    }
  }
  return nearest;
}

void main() {
  uint bundle = linear_invocation();
  uint count = splat_counts.data[kSplatsInUse];
  if (bundle >= count) return;
  uint begin = begins.data[bundle];
  uint end = bundle + 1 < count ? begins.data[bundle + 1] : point_counts.data[kPointsInAll];
  vec3 flux = vec3(0.0);
  vec3 origin = bundled_point(begin).position;
  vec3 offsets = vec3(0.0);
  for (uint i = begin; i < end; ++i) {
    LightPoint point = bundled_point(i);
    flux += point.flux;
    offsets += point.position - origin;
  }
  float bundled = float(end - begin);
  uint chosen = begin + hash_word(path_of(sorted.data[begin].y) ^ hash_word(sorted.data[begin].x)) % (end - begin);
  if (kNearestToMean) chosen = nearest_to(origin + offsets / bundled, begin, end);
  uint index = sorted.data[chosen].y;
  LightPoint point = points_at(index);
  point.flux = flux;
  make_splat(bundle, point, bundled, params.half_width > 0.0 ? 0.0 : areas.data[index], path_of(index));
}
