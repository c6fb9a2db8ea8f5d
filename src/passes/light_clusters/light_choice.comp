// One light point for each ray of each receiver, by resampled importance sampling (Talbot et al. 2005): M candidates
// x_j, systematic samples of the tile's distribution p, weigh w_j = t(x_j) / (M p(x_j)), t = F G v about their light; one
// of them, y, is chosen in proportion. f(y) / t(y) sum w is then right in the mean for any f, whatever t is, as long as
// t > 0 wherever f > 0.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_clusters/light_sampler_params.h"
#include "shaders/light_point.h"

layout(local_size_x = 8, local_size_y = 8) in;
LW_PUSH_CONSTANTS(LightChoiceParams, LW_CHOICE_PARAMS)
layout(set = 0, binding = 0) uniform sampler2D position;  // w: 0 where there is no receiver
layout(set = 0, binding = 1) uniform sampler2D normal;
layout(set = 0, binding = 2) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 3) readonly buffer ClusterBuffer { LightCluster data[]; } clusters;
layout(set = 0, binding = 4) readonly buffer PointBuffer { LightPoint data[]; } points;  // in the clusters' order
layout(set = 0, binding = 5) readonly buffer RunningBuffer { float data[]; } running;
layout(set = 0, binding = 6) readonly buffer DistributionBuffer { vec2 data[]; } distribution;
layout(set = 0, binding = 7) readonly buffer OrderBuffer { uvec2 data[]; } order;
layout(set = 0, binding = 8, rgba32ui) writeonly uniform uimage2D choice;

#include "passes/light_clusters/clusters_key.glsl"
#include "passes/light_clusters/light_clamp.glsl"
#include "shaders/light_point.glsl"
#include "shaders/luminance.glsl"
#include "shaders/random.glsl"
#include "shaders/software_drivers.glsl"

// The first cluster at which the running sum exceeds u.
uint find_cluster(uint base, uint count, float u) {
  uint low = 0;
  uint high = count - 1;
  for (int i = 0; i < 9; ++i) {
    uint middle = (low + high) / 2;
    bool beyond = distribution.data[base + middle].x > u;
    high = beyond ? middle : high;
    low = beyond ? low : min(middle + 1, high);
  }
  return low;
}

// The first point of the cluster at which the running sum exceeds `flux`.
uint find_point(LightCluster cluster, float flux) {
  uint low = cluster.first;
  uint high = cluster.first + cluster.count - 1;
  do {
    uint middle = (low + high) / 2;
    bool beyond = running.data[middle] > flux;
    high = beyond ? middle : high;
    low = beyond ? low : min(middle + 1, high);
  } while (low < high);
  return low;
}

struct Candidate {
  uint point;
  uint cluster;
  float weight;
  float target;
};

Candidate draw_candidate(uint base, uint count, float u, vec3 place, vec3 n) {
  Candidate result;
  result.cluster = find_cluster(base, count, u);
  float before = result.cluster > 0 ? distribution.data[base + result.cluster - 1].x : 0.0;
  vec2 entry = distribution.data[base + result.cluster];
  float probability = entry.x - before;
  LightCluster cluster = clusters.data[result.cluster];
  float inside = clamp((u - before) / max(probability, 1e-20), 0.0, 1.0);
  result.point = find_point(cluster, inside * cluster.flux);
  LightPoint point = points.data[result.point];
  float light = luminance(point.flux);
  float geometry = clamped_geometry(place, n, point, least_distance_squared(point.position));
  result.target = point.bounces <= params.most_bounces ? light * geometry * entry.y : 0.0;
  // The point's own probability is that of its cluster times light / cluster.flux.
  result.weight = light > 0.0 && probability > 0.0
                      ? result.target * cluster.flux / (light * probability * float(params.candidates)) : 0.0;
  return result;
}

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, params.size))) return;
  uvec2 tile = pixel / kLightTile;
  uint base = (tile.y * ((params.size.x + kLightTile - 1) / kLightTile) + tile.x) * kMostClusters;
  vec4 place = texelFetch(position, ivec2(pixel), 0);
  vec3 n = texelFetch(normal, ivec2(pixel), 0).xyz;
  uint count = cluster_count();
  bool lit = place.w > 0.0 && count > 0;
  for (uint ray = 0; ray < params.rays; ++ray) {
    vec2 random = stratified_point(pixel, params.first_sample + ray, params.sequence);
    Candidate chosen = Candidate(0, 0, 0.0, 0.0);
    float sum = 0.0;
    for (uint j = 0; j < LW_ROUNDS_IF(lit, params.candidates); ++j) {
      float u = (float(j) + random.x) / float(params.candidates);
      Candidate candidate = draw_candidate(base, count, u, place.xyz, n);
      // One random number does for all: what is left of it after a decision is again uniform.
      float before = sum;
      sum += candidate.weight;
      float at = random.y * sum;
      bool takes = at >= before && candidate.weight > 0.0;
      random.y = sum > 0.0 ? (takes ? (at - before) / max(candidate.weight, 1e-37) : at / max(before, 1e-37)) : random.y;
      random.y = clamp(random.y, 0.0, 0.99999994);
      if (takes) chosen = candidate;
    }
    float weight = chosen.target > 0.0 ? sum / chosen.target / float(params.rays) : 0.0;
    uvec4 words = uvec4(weight > 0.0 ? chosen.point : kNoChoice, floatBitsToUint(weight), chosen.cluster,
                        order.data[chosen.point].y);
    imageStore(choice, ivec2(pixel.x, pixel.y + ray * params.size.y), words);
  }
}
