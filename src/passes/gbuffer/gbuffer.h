// What the camera sees, pixel by pixel.
#pragma once

#include <cstdint>
#include <optional>

#include <glm/ext/vector_float3.hpp>

#include "graph/frame_graph.h"
#include "passes/gpu_scene/gpu_scene.h"

namespace lightwell {

// The G-buffer at render resolution. Depth is reversed: 1 at the near plane, 0 far away and where there is no surface.
struct GBuffer {
  ImageHandle position;  // RGBA32F: world position (m), w = distance along the camera's forward axis, 0: no surface
  ImageHandle normal;    // RGBA16F: unit shading normal towards the camera; w = 0
  ImageHandle albedo;    // RGBA16F: linear base colour; a = 1, 0 where there is no surface
  ImageHandle emission;  // RGBA32F: W/(sr m^2); the environment where there is no surface (a sun exceeds 16 bits);
                         // w = index of the surface's material (exact to 2^24)
  ImageHandle motion;    // RG16F: pixels moved since last frame, this frame's place minus last frame's
  ImageHandle face;   // RGBA16F: octahedral unit normal of the triangle, towards the camera (shaders/octahedral.glsl);
                      // z: last frame's distance along its camera's forward axis / this frame's
  ImageHandle depth;  // D32
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

// `camera`: glsl::GpuCamera. All triangles are drawn, whatever side they show; emission leaves the front only, unless
// the material is double-sided. `constant_background`: radiance of the environment where it is the same everywhere
// (then `environment` is not read).
GBuffer record_gbuffer(FrameGraph& graph, const GpuScene::Frame& scene, BufferHandle camera, ImageHandle environment,
                       std::uint32_t width, std::uint32_t height, std::optional<glm::vec3> constant_background = {});

}  // namespace lightwell
