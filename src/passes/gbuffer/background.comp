// The environment's radiance where the camera sees no surface.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/gbuffer/background_params.h"
#include "shaders/camera.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D position;
layout(set = 0, binding = 1) uniform sampler2D environment;
layout(set = 0, binding = 2) uniform Camera { LW_GPU_CAMERA(LW_DECLARE_MEMBER) } camera;
layout(set = 0, binding = 3, rgba32f) writeonly uniform image2D emission;

#include "shaders/environment.glsl"

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, params.size))) return;
  if (texelFetch(position, ivec2(pixel), 0).w > 0.0) return;
  vec2 ndc = (vec2(pixel) + 0.5 + camera.jitter) / vec2(params.size) * 2.0 - 1.0;
  vec3 direction = normalize(camera.forward + ndc.x * camera.tan_half_x * camera.right -
                             ndc.y * camera.tan_half_y * camera.up);
  imageStore(emission, ivec2(pixel), vec4(environment_radiance(direction), 0.0));
}
