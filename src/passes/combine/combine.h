// From the frame's parts to pictures.
#pragma once

#include <array>

#include "graph/frame_graph.h"
#include "passes/gbuffer/gbuffer.h"

namespace lightwell {

// What is to be combined; empty handles count as black.
struct LightParts {
  ImageHandle direct;    // irradiance, W/m^2
  ImageHandle indirect;  // irradiance, W/m^2
  ImageHandle specular;  // radiance, W/(sr m^2)
};

// Radiance towards the camera, RGBA32F: emission + albedo / pi * (direct + indirect) + specular.
ImageHandle record_combine(FrameGraph& graph, const GBuffer& gbuffer, const LightParts& parts);

// Sums over frames, RGBA32F each: radiance direct, indirect, emission; albedo (w: 1 where a surface is seen); normal
// (w: depth).
struct Film {
  std::array<ImageHandle, 5> images;
};

// Adds this frame to the film that the graph keeps, or starts it with this frame.
Film record_film(FrameGraph& graph, const GBuffer& gbuffer, const LightParts& parts, bool first_sample);

}  // namespace lightwell
