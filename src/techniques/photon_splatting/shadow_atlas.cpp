#include "techniques/photon_splatting/shadow_atlas.h"

#include <algorithm>
#include <cmath>

#include "kernels/techniques/photon_splatting/shadow_atlas_finish.comp.h"
#include "kernels/techniques/photon_splatting/shadow_atlas_trace.comp.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kLargestAtlas = 8192;  // texels a side: 256 MiB
constexpr std::uint32_t kSmallestMap = 4;      // texels a side
constexpr std::uint64_t kSplatGroupsOffset = glsl::kSplatGroups * sizeof(std::uint32_t);
constexpr std::uint64_t kTexelGroupsOffset = glsl::kTexelGroups * sizeof(std::uint32_t);

}  // namespace

SplatMapLayout fit_splat_maps(std::uint32_t maps, std::uint32_t map_side, std::uint32_t largest_image) {
  const std::uint32_t side = std::min(kLargestAtlas, largest_image);
  const auto most_maps = [side](std::uint32_t texels) { return side / texels * (side / texels); };
  while (map_side > kSmallestMap && maps > most_maps(map_side)) map_side /= 2;
  SplatMapLayout layout{.map_side = map_side, .capacity = std::clamp(maps, 1u, most_maps(map_side))};
  const auto square = static_cast<std::uint32_t>(std::ceil(std::sqrt(static_cast<double>(layout.capacity))));
  layout.maps_per_row = std::min(square, side / map_side);
  layout.rows = (layout.capacity + layout.maps_per_row - 1) / layout.maps_per_row;
  return layout;
}

ImageHandle record_shadow_atlas(FrameGraph& graph, WorldFrame& world, const SplatMapLayout& layout, bool receiver_test,
                                SplatKernel kernel, PhotonSplats& splats) {
  constexpr std::string_view kName = "photon splatting: shadow maps";
  ImageHandle atlas = graph.create_image("photon shadow maps", {.width = layout.maps_per_row * layout.map_side,
                                                                .height = layout.rows * layout.map_side,
                                                                .format = VK_FORMAT_R32_SFLOAT});
  trace_compute(graph, kName, kernels::photon_splatting_shadow_atlas_trace_comp, world)
      .read("splats", splats.splats)
      .read("starts", splats.starts)
      .read("splat_counts", splats.counts)
      .write("shadow_atlas", atlas)
      .constant("kReceiverTest", receiver_test ? 1 : 0)
      .push(splats.params)
      .dispatch_indirect(splats.counts, kTexelGroupsOffset);
  if (receiver_test) {
    graph.compute(kName, kernels::photon_splatting_shadow_atlas_finish_comp)
        .write("splats", splats.splats)
        .read("splat_counts", splats.counts)
        .write("shadow_atlas", atlas)
        .constant("kKernel", static_cast<std::uint32_t>(kernel))
        .push(splats.params)
        .dispatch_indirect(splats.counts, kSplatGroupsOffset);
  }
  return atlas;
}

}  // namespace lightwell
