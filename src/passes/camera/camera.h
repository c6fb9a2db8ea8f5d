// From the scene's camera to the shaders'.
#pragma once

#include <glm/ext/vector_float2.hpp>
#include <glm/ext/vector_uint2.hpp>

#include "lightwell/scene.h"
#include "shaders/camera.h"

namespace lightwell {

// `jitter`: where in the pixel the image is sampled, from its centre, in pixels. `previous`: last frame's camera, or
// null where there is none (then nothing seems to have moved).
glsl::GpuCamera make_gpu_camera(const WorldCamera& camera, glm::uvec2 size, glm::vec2 jitter,
                                const glsl::GpuCamera* previous);

}  // namespace lightwell
