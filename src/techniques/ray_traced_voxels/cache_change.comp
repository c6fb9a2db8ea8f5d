// Whether the light of a pixel has changed: what the end of one of last frame's rays got straight from sources of light,
// and what the same shadow ray, of the same random numbers, finds there now. Where nothing has changed the difference is 0,
// whatever the noise of sampling. One pixel in kChangeBlock^2 is asked.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/noise_filter/light_change_types.h"
#include "shaders/lights.h"
#include "passes/light_cache/cache_types.h"

layout(local_size_x = 8, local_size_y = 8) in;

#include "shaders/trace.glsl"

#include "passes/light_cache/cache_direct.glsl"

layout(set = 0, binding = 5) uniform sampler2D position;
layout(set = 0, binding = 6) uniform sampler2D motion;
layout(set = 0, binding = 7) uniform usampler2D reprojection;
layout(set = 0, binding = 8) uniform usampler2D last_ends_0;
layout(set = 0, binding = 9) uniform usampler2D last_ends_1;
layout(set = 0, binding = 10, rgba32f) writeonly uniform image2D change;  // difference, its square, the larger of both

#include "passes/reprojection/reprojection.glsl"
#include "techniques/ray_traced_voxels/cache_memory.glsl"

// params.frame: the one before this; of its rays, params.count a pixel, the last one's end is remembered.
void main() {
  uvec2 block = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(block, uvec2(imageSize(change))))) return;
  uvec2 pixel = pixel_of_turn(block, params.turn, params.size);
  vec4 place = texelFetch(position, ivec2(pixel), 0);
  Reprojection r = load_reprojection(ivec2(pixel));
  vec3 result = vec3(0.0);
  if (place.w > 0.0 && r.taps != 0) {
    const uint kTurns = kChangeBlock * kChangeBlock;
    uvec2 last_block = uvec2(history_tap(r.place, findLSB(r.taps)).texel) / kChangeBlock;
    uvec2 last_pixel = pixel_of_turn(last_block, (params.turn + kTurns - 1) % kTurns, params.size);
    RayEnd end =
        ray_end_of(texelFetch(last_ends_0, ivec2(last_block), 0), texelFetch(last_ends_1, ivec2(last_block), 0));
    if (end.all > 0.0) {
      Receiver receiver = make_receiver(vec4(end.position, 0.0), unpack_unit_vector(end.normal),
                                        unpack_unit_vector(end.face_normal), 0.0);
      vec3 now = direct_at(receiver, last_pixel, params.frame * params.count + params.count - 1, 1);
      float difference = luminance(unpackUnorm4x8(end.albedo).rgb * now) - end.direct;
      result = vec3(difference, difference * difference, max(end.all, end.all + difference));
    }
  }
  imageStore(change, ivec2(block), vec4(result, 0.0));
}
