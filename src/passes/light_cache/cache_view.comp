// What the cache holds for each pixel's face, as it is: no interpolation, and nothing is asked for.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_cache/cache_types.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool kIndirect = true;  // or what comes straight from sources
layout(set = 0, binding = 0) uniform sampler2D position;
layout(set = 0, binding = 1) uniform sampler2D face;
layout(set = 0, binding = 2) readonly buffer FaceTableBuffer { uint data[]; } face_table;
layout(set = 0, binding = 3) readonly buffer ShownBuffer { vec4 data[]; } shown;
layout(set = 0, binding = 4) readonly buffer IndirectBuffer { vec4 data[]; } indirect;
layout(set = 0, binding = 5, rgba32f) writeonly uniform image2D picture;

#include "passes/voxel_faces/voxel_faces.glsl"
#include "shaders/octahedral.glsl"

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, params.size))) return;
  vec4 place = texelFetch(position, ivec2(pixel), 0);
  vec3 light = vec3(0.0);
  if (place.w > 0.0) {
    uint level;
    uint own = face_at(params.levels, place.xyz, from_octahedron(texelFetch(face, ivec2(pixel), 0).xy), 0.0, level);
    if (own != kNoFace) light = kIndirect ? indirect.data[own].rgb : shown.data[own * kShownWords + kShownSource].rgb;
  }
  imageStore(picture, ivec2(pixel), vec4(light, 1.0));
}
