// The surfaces in each tile: box, cone of normals, and which parts of its depth range hold any (Harada 2012).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/photon_splatting/splat_view_types.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kTile = kSplatTile;  // side, samples
LW_PUSH_CONSTANTS(SplatTileParams, LW_SPLAT_TILE_PARAMS)
layout(set = 0, binding = 0) uniform sampler2D position;  // w: 0 where there is no surface
layout(set = 0, binding = 1) uniform sampler2D face;
layout(set = 0, binding = 2) writeonly buffer TileBuffer { SplatTile data[]; } tiles;

#include "shaders/octahedral.glsl"
#include "techniques/photon_splatting/splat_samples.glsl"

shared vec4 part_low[64];   // w: nearest
shared vec4 part_high[64];  // w: farthest
shared vec4 part_normal[64];
shared SplatTile tile;
shared uint slabs;

const uint kRow = kTile * kTile / 64;  // samples that one invocation looks at

ivec2 sample_of(uint i) {
  uint k = gl_LocalInvocationID.x * kRow + i;
  return ivec2(gl_WorkGroupID.xy * kTile + uvec2(k % kTile, k / kTile));
}

bool is_surface(uint i, out vec4 place) {
  place = texelFetch(position, pixel_of_sample(sample_of(i)), 0);
  return all(lessThan(sample_of(i), sample_count())) && place.w > 0.0;
}

vec3 face_of(uint i) { return from_octahedron(texelFetch(face, pixel_of_sample(sample_of(i)), 0).xy); }

void main() {
  uint local = gl_LocalInvocationID.x;
  uint index = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  vec4 low = vec4(3e38);
  vec4 high = vec4(-3e38);
  vec3 normals = vec3(0.0);
  vec4 place;
  for (uint i = 0; i < kRow; ++i) {
    if (!is_surface(i, place)) continue;
    low = min(low, place);
    high = max(high, place);
    normals += face_of(i);
  }
  part_low[local] = low;
  part_high[local] = high;
  part_normal[local] = vec4(normals, 0.0);
  if (local == 0) slabs = 0;
  barrier();

  low = vec4(3e38);
  high = vec4(-3e38);
  normals = vec3(0.0);
  for (uint i = 0; i < 64; ++i) {
    low = min(low, part_low[i]);
    high = max(high, part_high[i]);
    normals += part_normal[i].xyz;
  }
  vec3 axis = dot(normals, normals) > 1e-6 ? normalize(normals) : vec3(0.0, 0.0, 1.0);
  float per_depth = float(kSplatSlabs) / max(high.w - low.w, 1e-30);
  uint mine = 0;
  float cosine = 1.0;
  for (uint i = 0; i < kRow; ++i) {
    if (!is_surface(i, place)) continue;
    mine |= 1u << uint(clamp((place.w - low.w) * per_depth, 0.0, float(kSplatSlabs - 1)));
    cosine = min(cosine, dot(axis, face_of(i)));
  }
  atomicOr(slabs, mine);
  barrier();
  part_low[local].x = cosine;
  barrier();
  if (local != 0) return;
  for (uint i = 0; i < 64; ++i) cosine = min(cosine, part_low[i].x);
  tiles.data[index] = SplatTile(low.xyz, low.w, high.xyz, high.w, axis, cosine, uvec3(0), slabs);
}
