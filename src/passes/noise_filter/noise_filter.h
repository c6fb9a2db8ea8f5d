// Noise of images that a few random samples a pixel and frame make: the mean over frames, and a filter over neighbours
// that fades as the noise falls. For any diffuse light of visible surfaces.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "graph/frame_graph.h"
#include "passes/gbuffer/gbuffer.h"
#include "passes/reprojection/reprojection.h"
#include "shaders/camera.h"

namespace lightwell {

// A signal's history up to and with this frame.
struct TemporalMean {
  ImageHandle mean;         // RGBA32F: rgb in the signal's unit, w: frames in it
  ImageHandle mean_square;  // R32F: of the luminance
  bool has_history = false;
};

// How a frame and the mean of those before come together.
struct TemporalBlend {
  float blend_factor = 1.0f;  // weight of frame n: blend_factor / (n - 1 + blend_factor); 1: all frames count the same
  float most_frames = 1e6f;   // that the history counts for
  ImageHandle limits;         // x: the same, block by block of the picture, where light may have changed; or empty
  std::uint32_t limit_block = 0;  // side of the blocks, pixels
};

// Pixels between the taps of the filter's rounds, along the diagonals and along the axes by turns.
inline constexpr int kNarrowFilter[] = {1, 1, 2, 2};            // for stratified samples of light that is nearly there
inline constexpr int kWideFilter[] = {1, 1, 2, 2, 4, 4, 8, 8};  // for one ray a pixel

// Declares the mean over frames of `signal` (rgb, size of the G-buffer). Its histories bear the name.
TemporalMean record_temporal_mean(FrameGraph& graph, std::string_view name, ImageHandle signal,
                                  const Reprojection& reprojection, const TemporalBlend& blend);

// Declares the filter: the variance of `signal`, then rounds of an edge-aware filter. Gives RGBA32F: rgb in the
// signal's unit, w what is left of the luminance's variance.
ImageHandle record_noise_filter(FrameGraph& graph, std::string_view name, const TemporalMean& signal,
                                const GBuffer& gbuffer, const glsl::GpuCamera& camera,
                                std::span<const int> steps = kNarrowFilter);

}  // namespace lightwell
