// Which parts of the scene a view may see.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "passes/gpu_scene/gpu_scene.h"
#include "shaders/shadow_view.h"

namespace lightwell {

struct IndexRange {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

// Indices of all parts, either alpha-masked or opaque, whose bounds meet the volume of one of a light's views. Short
// gaps between them are filled with what is in between: it is drawn in vain, which costs less than one more draw.
std::vector<IndexRange> list_visible_ranges(std::span<const PartRange> parts, bool alpha_masked,
                                            const glsl::ShadowView& view, std::uint32_t face);

}  // namespace lightwell
