// The light of each receiver's chosen light points, with their shadows; what the rays tell goes into the tally of learned
// visibility. The including kernel, 8 x 8 invocations a group, has bindings 0 to 3 of set 0 for itself and defines
//   bool is_occluded(Receiver receiver, LightPoint point);
// before including this file.
#ifndef LIGHTWELL_LIGHT_GATHER_GLSL
#define LIGHTWELL_LIGHT_GATHER_GLSL

LW_PUSH_CONSTANTS(LightGatherParams, LW_LIGHT_GATHER_PARAMS)
layout(set = 0, binding = 4) uniform sampler2D position;
layout(set = 0, binding = 5) uniform sampler2D normal;
layout(set = 0, binding = 6) uniform sampler2D face;
layout(set = 0, binding = 7) uniform usampler2D choice;
layout(set = 0, binding = 8) readonly buffer PointBuffer { LightPoint data[]; } points;
layout(set = 0, binding = 9) readonly buffer ClusterBuffer { LightCluster data[]; } clusters;
layout(set = 0, binding = 10) readonly buffer TileBuffer { LightTile data[]; } tiles;
layout(set = 0, binding = 11) buffer LearnedBuffer { uint data[]; } learned;
layout(set = 0, binding = 12, rgba32f) writeonly uniform image2D irradiance;
// What each pixel's first ray was: the point's number, its weight, whether it was seen.
layout(set = 0, binding = 13, rgba32ui) writeonly uniform uimage2D memory;

#include "passes/light_clusters/learned_visibility.glsl"
#include "passes/light_clusters/light_clamp.glsl"

void remember_ray(uint tile_cell, uint cluster, bool seen) {
  uint slot = learned_slot(tile_cell, clusters.data[cluster].key);
  atomicAdd(learned.data[slot + kLearnedNewRays], 1);
  if (seen) atomicAdd(learned.data[slot + kLearnedNewUnblocked], 1);
}

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, params.size))) return;
  vec4 place = texelFetch(position, ivec2(pixel), 0);
  Receiver receiver = make_receiver(place, texelFetch(normal, ivec2(pixel), 0).xyz,
                                    from_octahedron(texelFetch(face, ivec2(pixel), 0).xy), params.clearance);
  uvec2 tile = pixel / kLightTile;
  uint tile_cell = tiles.data[tile.y * ((params.size.x + kLightTile - 1) / kLightTile) + tile.x].cell;
  vec3 sum = vec3(0.0);
  uvec4 first = uvec4(kNoChoice, 0, 0, 0);
  for (uint ray = 0; ray < (place.w > 0.0 ? params.rays : 0); ++ray) {
    uvec4 chosen = texelFetch(choice, ivec2(pixel.x, pixel.y + ray * params.size.y), 0);
    LightPoint point = points.data[chosen.x == kNoChoice ? 0 : chosen.x];
    float weight = chosen.x == kNoChoice ? 0.0 : uintBitsToFloat(chosen.y);
    float geometry = clamped_geometry(place.xyz, receiver.normal, point, least_distance_squared(point.position));
    if (dot(receiver.face, point.position - place.xyz) <= 0.0) geometry = 0.0;
    vec3 light = light_point_irradiance(point, geometry) * weight;
    if (light == vec3(0.0)) continue;
    bool seen = !is_occluded(receiver, point);
    remember_ray(tile_cell, chosen.z, seen);
    sum += seen ? light : vec3(0.0);
    if (ray == 0) first = uvec4(chosen.w, chosen.y, seen ? 1 : 0, 0);
  }
  imageStore(irradiance, ivec2(pixel), vec4(sum, 1.0));
  if (kRemember) imageStore(memory, ivec2(pixel), first);
}

#endif
