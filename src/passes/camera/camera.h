// From the scene's camera to the shaders'.
#pragma once

#include <glm/ext/vector_float2.hpp>
#include <glm/ext/vector_uint2.hpp>

#include "lightwell/scene.h"
#include "shaders/camera.h"

namespace lightwell {

// Where an image is sampled.
struct PixelSample {
  glm::vec2 jitter{0.0f};  // from the pixel's centre, pixels
  float footprint = 1.0f;  // side of the part of the pixel that the sample stands for, pixels
};

// `previous`: last frame's camera, or null where there is none (then nothing seems to have moved).
glsl::GpuCamera make_gpu_camera(const WorldCamera& camera, glm::uvec2 size, const PixelSample& sample,
                                const glsl::GpuCamera* previous);

// The camera as shaders can have it: perspective. An orthographic one becomes one so far behind its place that what it
// shows of `bounds` moves by less than half a thousandth of the picture's height; its near plane stays where it is.
struct EyeCamera {
  WorldCamera camera;
  float behind = 0.0f;  // m; of its place
};
EyeCamera make_perspective(const WorldCamera& camera, const Bounds& bounds);

// Where rays start that leave the surface in a pixel: so far above it, in m for each metre between it and the camera.
// A fiftieth of a pixel's side, more than the rasteriser's interpolation errs.
float pixel_clearance(const glsl::GpuCamera& camera);

// Side of a pixel on a plane 1 m before the camera, m.
float pixel_tangent(const glsl::GpuCamera& camera);

}  // namespace lightwell
