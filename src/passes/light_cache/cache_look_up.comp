// Indirect irradiance at the picture's pixels, from the cache.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_cache/cache_types.h"
#include "shaders/light_point.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D position;
layout(set = 0, binding = 1) uniform sampler2D face;
layout(set = 0, binding = 2) readonly buffer FaceTableBuffer { uint data[]; } face_table;
layout(set = 0, binding = 3) readonly buffer LitBuffer { LitFace data[]; } lit;
layout(set = 0, binding = 4) buffer VoteBuffer { uint data[]; } votes;
layout(set = 0, binding = 5, rgba32f) writeonly uniform image2D irradiance;
layout(set = 0, binding = 6) readonly buffer KeyBuffer { uint data[]; } keys;
layout(set = 0, binding = 7) uniform sampler2D normal;

#include "shaders/octahedral.glsl"
#include "passes/light_cache/cache_look_up.glsl"

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, params.size))) return;
  vec4 place = texelFetch(position, ivec2(pixel), 0);
  vec3 e = vec3(0.0);
  if (place.w > 0.0) {
    uint seed = pixel.x ^ pixel.y << 16 ^ params.frame * 0x9e3779b9u;
    e = look_up(place.xyz, texelFetch(normal, ivec2(pixel), 0).xyz,
                from_octahedron(texelFetch(face, ivec2(pixel), 0).xy), seed);
  }
  imageStore(irradiance, ivec2(pixel), vec4(e, 1.0));
}
