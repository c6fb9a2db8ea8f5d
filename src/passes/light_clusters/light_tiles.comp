// For each tile of receivers, how probable each cluster is to be sampled:
//   p(c) = (1 - a) F_c G_c v_c / sum + a F_c / sum F,
// F_c its luminance, G_c about the largest geometry term between tile and cluster, v_c the visibility learned so far.
// The last part keeps every cluster alive: whatever G_c and v_c say, the estimate stays right in the mean.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_clusters/light_sampler_params.h"

layout(local_size_x = 64) in;
LW_PUSH_CONSTANTS(LightTileParams, LW_TILE_PARAMS)
layout(set = 0, binding = 0) uniform sampler2D position;  // w: 0 where there is no receiver
layout(set = 0, binding = 1) uniform sampler2D normal;
layout(set = 0, binding = 2) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 3) readonly buffer ClusterBuffer { LightCluster data[]; } clusters;
layout(set = 0, binding = 4) readonly buffer LearnedBuffer { uint data[]; } learned;
layout(set = 0, binding = 5) writeonly buffer TileBuffer { LightTile data[]; } tiles;
layout(set = 0, binding = 6) buffer DistributionBuffer { vec2 data[]; } distribution;  // running sum of p, v

#include "passes/light_clusters/clusters_key.glsl"
#include "passes/light_clusters/learned_visibility.glsl"
#include "passes/light_clusters/light_clamp.glsl"
#include "shaders/normal_direction.glsl"

const float kDefensivePart = 0.1;
const float kLeastVisibility = 0.1;

shared vec3 part_low[64];
shared vec3 part_high[64];
shared vec4 part_normal[64];  // w: receivers
shared vec2 part_sum[64];     // of F G v, of F
shared LightTile tile;

// Each invocation looks at a row of 4 pixels.
void join_receivers(uvec2 corner) {
  uint local = gl_LocalInvocationID.x;
  vec3 low = vec3(3e38);
  vec3 high = vec3(-3e38);
  vec4 normals = vec4(0.0);
  for (uint i = 0; i < 4; ++i) {
    ivec2 pixel = ivec2(corner + uvec2((local & 3u) * 4 + i, local >> 2));
    bool inside = all(lessThan(pixel, ivec2(params.size)));
    vec4 place = texelFetch(position, min(pixel, ivec2(params.size) - 1), 0);
    if (!inside || place.w <= 0.0) continue;
    low = min(low, place.xyz);
    high = max(high, place.xyz);
    normals += vec4(texelFetch(normal, pixel, 0).xyz, 1.0);
  }
  part_low[local] = low;
  part_high[local] = high;
  part_normal[local] = normals;
}

LightTile describe_tile() {
  vec3 low = vec3(3e38);
  vec3 high = vec3(-3e38);
  vec4 normals = vec4(0.0);
  for (uint i = 0; i < 64; ++i) {
    low = min(low, part_low[i]);
    high = max(high, part_high[i]);
    normals += part_normal[i];
  }
  LightTile result = LightTile(vec3(0.0), -1.0, vec3(0.0), 0);
  if (normals.w > 0.0) {
    result.center = 0.5 * (low + high);
    result.radius = 0.5 * length(high - low);
    result.normal = normals.xyz / normals.w;
    uvec3 cell = uvec3(ivec3(floor(result.center / params.learned_cell)));
    result.cell = hash_word(cell.x + hash_word(cell.y + hash_word(cell.z))) + normal_direction(result.normal);
  }
  return result;
}

// About the largest geometry term cos cos / d^2 between the tile's receivers and the cluster's points.
float geometry_bound(LightCluster cluster) {
  vec3 to_cluster = cluster.center - tile.center;
  float distance_squared = dot(to_cluster, to_cluster);
  float reach = cluster.radius + tile.radius;
  float distance_or_reach = sqrt(max(distance_squared, 1e-30));
  vec3 direction = to_cluster / distance_or_reach;
  float slack = min(1.0, reach / distance_or_reach);
  float receiver_slack = slack + 1.0 - length(tile.normal);
  float cosine = clamp(dot(tile.normal, direction) + receiver_slack, 0.0, 1.0);
  float cosine_there = clamp(-dot(cluster.axis, direction) + slack + 1.0 - cluster.cosine, 0.0, 1.0);
  // Of points spread evenly over a ball round the receiver, the mean of 1 / d^2 is 3 / r^2.
  float mean_squared = max(distance_squared, reach * reach / 3.0);
  return cosine * cosine_there / max(mean_squared, least_distance_squared(cluster.center));
}

void main() {
  uint local = gl_LocalInvocationID.x;
  uvec2 tile_count = (params.size + kLightTile - 1) / kLightTile;
  uint tile_index = gl_WorkGroupID.y * tile_count.x + gl_WorkGroupID.x;
  join_receivers(gl_WorkGroupID.xy * kLightTile);
  barrier();
  if (local == 0) {
    tile = describe_tile();
    tiles.data[tile_index] = tile;
  }
  barrier();

  uint count = tile.radius >= 0.0 ? cluster_count() : 0;
  uint each = (count + 63) / 64;
  uint first = min(local * each, count);
  uint end = min(first + each, count);
  uint base = tile_index * kMostClusters;
  vec2 sum = vec2(0.0);
  for (uint c = first; c < end; ++c) {
    LightCluster cluster = clusters.data[c];
    float visibility = max(kLeastVisibility, learned_visibility(learned_slot(tile.cell, cluster.key)));
    float weight = cluster.flux * geometry_bound(cluster) * visibility;
    sum += vec2(weight, cluster.flux);
    distribution.data[base + c] = vec2(weight, visibility);
  }
  part_sum[local] = sum;
  barrier();
  vec2 before = vec2(0.0);
  vec2 all = vec2(0.0);
  for (uint i = 0; i < 64; ++i) {
    if (i == local) before = all;
    all += part_sum[i];
  }
  float defensive = all.x > 0.0 ? kDefensivePart : 1.0;
  vec2 scale = vec2(all.x > 0.0 ? (1.0 - defensive) / all.x : 0.0, all.y > 0.0 ? defensive / all.y : 0.0);
  float running = dot(before, scale);
  for (uint c = first; c < end; ++c) {
    vec2 entry = distribution.data[base + c];
    running += dot(vec2(entry.x, clusters.data[c].flux), scale);
    distribution.data[base + c] = vec2(c + 1 == count ? 1.0 : min(running, 1.0), entry.y);
  }
}
