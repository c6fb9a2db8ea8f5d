#include "passes/noise_filter/light_change.h"

#include "kernels/passes/noise_filter/change_filter.comp.h"
#include "passes/noise_filter/light_change_params.h"

namespace lightwell {

glm::uvec2 change_blocks(glm::uvec2 size) {
  return (size + glsl::kChangeBlock - 1u) / glsl::kChangeBlock;
}

std::uint32_t change_turn(std::uint64_t index) {
  return static_cast<std::uint32_t>(index % (glsl::kChangeBlock * glsl::kChangeBlock));
}

ImageHandle record_change_limits(FrameGraph& graph, std::string_view name, ImageHandle change) {
  const ImageDesc desc = graph.desc(change);
  const glm::uvec2 blocks(desc.width, desc.height);
  for (const int step : {1, 2, 4}) {
    ImageHandle filtered = graph.create_image("light change, filtered", desc);
    graph.compute(name, kernels::noise_filter_change_filter_comp)
        .read("sums", change)
        .write("filtered", filtered)
        .constant("kLast", step == 4 ? 1 : 0)
        .push(glsl::LightChangeParams{blocks, step})
        .dispatch_threads(blocks.x, blocks.y);
    change = filtered;
  }
  return change;
}

}  // namespace lightwell
