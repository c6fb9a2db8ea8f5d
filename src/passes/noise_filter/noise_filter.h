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
  bool weighted = false;          // signal's w: how much of a frame each pixel counts for; false: all of it
};

struct NoiseFilterSettings {
  std::span<const int> steps;  // pixels between the taps of each round, along the diagonals and along the axes by turns
  bool keeps_light =
      false;  // the sum over all pixels stays what it was, however skewed the noise; smooths less at edges
  bool independent = false;  // samples of many dimensions, whose mean over frames has hardly less noise than if they
                             // were independent; false: stratified ones
};

inline constexpr int kNarrowSteps[] = {1, 1, 2, 2};
inline constexpr int kWideSteps[] = {1, 1, 2, 2, 4, 4, 8, 8};
inline constexpr NoiseFilterSettings kNarrowFilter{kNarrowSteps};    // for stratified samples
inline constexpr NoiseFilterSettings kWideFilter{kWideSteps, true};  // for one ray a pixel that meets light or none
inline constexpr NoiseFilterSettings kPathFilter{kWideSteps, true, true};  // for paths of several rays

// Declares the mean over frames of `signal` (rgb, size of the G-buffer). Its histories bear the name.
TemporalMean record_temporal_mean(FrameGraph& graph, std::string_view name, ImageHandle signal,
                                  const Reprojection& reprojection, const TemporalBlend& blend);

// Declares the filter: the variance of `signal`, then rounds of an edge-aware filter. Gives RGBA32F: rgb in the
// signal's unit, w what is left of the luminance's variance.
ImageHandle record_noise_filter(FrameGraph& graph, std::string_view name, const TemporalMean& signal,
                                const GBuffer& gbuffer, const glsl::GpuCamera& camera,
                                const NoiseFilterSettings& settings = kNarrowFilter);

}  // namespace lightwell
