// The scene as a dim picture: albedo by the cosine towards the camera.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/camera.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D position;
layout(set = 0, binding = 1) uniform sampler2D normal;
layout(set = 0, binding = 2) uniform sampler2D albedo;
layout(set = 0, binding = 3, rgba16f) writeonly uniform image2D picture;
layout(set = 0, binding = 4) uniform Camera { LW_GPU_CAMERA(LW_DECLARE_MEMBER) } camera;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(picture)))) return;
  vec4 place = texelFetch(position, pixel, 0);
  vec3 color = vec3(0.0);
  if (place.w > 0.0) {
    float cosine = dot(texelFetch(normal, pixel, 0).xyz, normalize(camera.position - place.xyz));
    color = 0.25 * cosine * texelFetch(albedo, pixel, 0).rgb;
  }
  imageStore(picture, pixel, vec4(max(color, vec3(0.0)), 1.0));
}
