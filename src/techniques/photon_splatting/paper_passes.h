// What follows the accumulation of splats, as published.
#pragma once

#include <cstdint>

#include "passes/gbuffer/gbuffer.h"

namespace lightwell {

// RGBA32F: exposure * xyz / w of `accumulated`; the ambient irradiance where w is 0. w: 1 where there is a surface.
ImageHandle record_paper_normalise(FrameGraph& graph, const GBuffer& gbuffer, ImageHandle accumulated, float exposure,
                                   float ambient);

// A Gaussian filter of 2 `radius` + 1 taps across, then down, over pixels with a surface. `radius` 0: `source` itself.
ImageHandle record_paper_blur(FrameGraph& graph, ImageHandle source, std::uint32_t radius);

}  // namespace lightwell
