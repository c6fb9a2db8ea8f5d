// Indirect irradiance at the picture's pixels, from the cache.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/ray_traced_voxels/cache_types.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D position;
layout(set = 0, binding = 1) uniform sampler2D face;
layout(set = 0, binding = 2) readonly buffer FaceTableBuffer { uint data[]; } face_table;
layout(set = 0, binding = 3) readonly buffer IndirectBuffer { vec4 data[]; } indirect;
layout(set = 0, binding = 4) buffer VoteBuffer { uint data[]; } votes;
layout(set = 0, binding = 5, rgba32f) writeonly uniform image2D irradiance;

#include "shaders/octahedral.glsl"
#include "techniques/ray_traced_voxels/cache_look_up.glsl"

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, params.size))) return;
  vec4 place = texelFetch(position, ivec2(pixel), 0);
  vec3 n = from_octahedron(texelFetch(face, ivec2(pixel), 0).xy);
  vec3 e = place.w > 0.0 ? look_up(place.xyz, n, pixel.x ^ pixel.y << 16 ^ params.frame * 0x9e3779b9u) : vec3(0.0);
  imageStore(irradiance, ivec2(pixel), vec4(e, 1.0));
}
