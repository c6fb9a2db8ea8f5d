// The camera as the shaders see it: the uniform `camera` of every pass that needs it. Declare it in the kernel's entry:
//   layout(set = 0, binding = n) uniform Camera { LW_GPU_CAMERA(LW_DECLARE_MEMBER) } camera;   // camera.position, ...
// Clip space is Vulkan's with y down and reversed depth: 1 at znear, 0 at infinity (nothing is cut off far away).
#ifndef LIGHTWELL_SHADERS_CAMERA_H
#define LIGHTWELL_SHADERS_CAMERA_H

#include "shaders/shared.h"

#define LW_GPU_CAMERA(MEMBER)                                                                           \
  MEMBER(mat4, view_projection)          /* world to clip, sub-pixel jitter included */                 \
  MEMBER(mat4, steady_view_projection)   /* the same without jitter */                                  \
  MEMBER(mat4, previous_view_projection) /* last frame's, without jitter */                             \
  MEMBER(vec3, position)                 /* m */                                                        \
  MEMBER(float, tan_half_y)              /* of half the vertical field of view */                       \
  MEMBER(vec3, forward)                  /* unit */                                                     \
  MEMBER(float, tan_half_x)                                                                             \
  MEMBER(vec3, right)      /* unit */                                                                   \
  MEMBER(float, znear)     /* m */                                                                      \
  MEMBER(vec3, up)         /* unit, perpendicular to forward */                                         \
  MEMBER(float, footprint) /* side of what one sample stands for, pixels; scales texture derivatives */ \
  MEMBER(vec2, jitter)     /* of the sample from the pixel's centre, pixels, in [-1/2, 1/2] */          \
  MEMBER(uvec2, size)      /* pixels */
LW_STRUCT(GpuCamera, LW_GPU_CAMERA)

#endif
