// From re-evaluated samples of light, for how many frames each part of a picture's history may count.
#pragma once

#include <cstdint>

#include <glm/ext/vector_uint2.hpp>

#include "graph/frame_graph.h"
#include "passes/noise_filter/light_change_types.h"

namespace lightwell {

// Blocks of kChangeBlock^2 pixels in a picture.
glm::uvec2 change_blocks(glm::uvec2 size);

// Which pixel of each block is asked in frame `index`.
std::uint32_t change_turn(std::uint64_t index);

// Declares the filter. `change`: RGBA32F, a texel a block: what a sample of last frame brings now less what it brought
// then, the square of that, the larger of both; all 0 where nothing is known. Gives TemporalBlend::limits, for blocks
// of kChangeBlock pixels.
ImageHandle record_change_limits(FrameGraph& graph, std::string_view name, ImageHandle change);

}  // namespace lightwell
