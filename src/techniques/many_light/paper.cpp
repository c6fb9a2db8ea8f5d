#include "techniques/many_light/paper.h"

#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "kernels/techniques/many_light/merge.comp.h"
#include "kernels/techniques/many_light/paper_filter.comp.h"
#include "kernels/techniques/many_light/paper_gather_rays.comp.h"
#include "kernels/techniques/many_light/paper_gather_svo.comp.h"
#include "kernels/techniques/many_light/paper_gather_unshadowed.comp.h"
#include "kernels/techniques/many_light/paper_gather_voxels.comp.h"
#include "kernels/techniques/many_light/split.comp.h"
#include "techniques/many_light/many_light_types.h"
#include "techniques/many_light/visibility.h"

namespace lightwell {
namespace {

// Luminance below which a light point is not looked at, W: nothing that could be seen.
constexpr float kLeastFlux = 1e-12f;

ImageHandle create(FrameGraph& graph, std::string_view name, glm::uvec2 size, VkFormat format) {
  return graph.create_image(name, {.width = size.x, .height = size.y, .format = format});
}

constexpr GatherKernels kGather{kernels::many_light_paper_gather_rays_comp,
                                kernels::many_light_paper_gather_voxels_comp, kernels::many_light_paper_gather_svo_comp,
                                kernels::many_light_paper_gather_unshadowed_comp};

struct SplitGBuffer {
  ImageHandle position, normal, face;
};

}  // namespace

ManyLightPaper::ManyLightPaper() {
  world_options_ = {.paths = 1024,
                    .bounces = 1,
                    .rsm_lights = 16,
                    .visibility = Visibility::kSvoRestart,
                    .epsilon = 3.0f,
                    .resolution = 2,
                    .published = true};
}

void ManyLightPaper::describe(OptionVisitor& visitor) {
  describe_world_options(visitor, world_options_);
  visitor.visit({"clamp", "Distance below which a virtual light gets no brighter, as part of the scene's diagonal.", "",
                 "light in corners is lost"},
                options_.clamp, 0.0f, 1.0f);
  visitor.visit({"filter-distance", "How far a neighbour may be that is mixed in, as part of the scene's diagonal.", "",
                 "detail is lost"},
                options_.filter_distance, 0.0f, 1.0f);
  visitor.visit({"filter-angle", "How much its normal may differ.", "degrees", "detail is lost"}, options_.filter_angle,
                0.0f, 180.0f);
}

GiResult ManyLightPaper::record_view(FrameGraph& graph, TechniqueWorld* world_part, ViewFrame& view) {
  const auto& world = *static_cast<ManyLightWorld*>(world_part);
  const GBuffer& gbuffer = view.gbuffer;
  const glm::uvec2 size(gbuffer.width, gbuffer.height);
  const glm::uvec2 tile_size = (size + glsl::kSplit - 1u) / glsl::kSplit;
  const glm::uvec2 split_size = tile_size * glsl::kSplit;
  const float diagonal = glm::length(view.world.snapshot.bounds.maximum - view.world.snapshot.bounds.minimum);

  SplitGBuffer split{create(graph, "split position", split_size, VK_FORMAT_R32G32B32A32_SFLOAT),
                     create(graph, "split normal", split_size, VK_FORMAT_R16G16B16A16_SFLOAT),
                     create(graph, "split face", split_size, VK_FORMAT_R16G16B16A16_SFLOAT)};
  graph.compute("many light: split", kernels::many_light_split_comp)
      .read("position", gbuffer.position)
      .read("normal", gbuffer.normal)
      .read("face", gbuffer.face)
      .write("split_position", split.position)
      .write("split_normal", split.normal)
      .write("split_face", split.face)
      .push(glsl::SplitParams{size, tile_size})
      .dispatch_threads(split_size.x, split_size.y);

  ImageHandle split_light = create(graph, "split light", split_size, VK_FORMAT_R32G32B32A32_SFLOAT);
  const float clamp = options_.clamp * diagonal;
  ComputePass& gather = gather_compute(graph, "many light: gather", kGather, view.world, world);
  gather.read("split_position", split.position)
      .read("split_normal", split.normal)
      .read("split_face", split.face)
      .read("points", world.points())
      .write("split_light", split_light)
      .push(glsl::PaperGatherParams{.tile_size = tile_size,
                                    .paths = static_cast<std::uint32_t>(world.options().paths),
                                    .bounces = static_cast<std::uint32_t>(world.options().bounces),
                                    .least_distance_squared = clamp * clamp,
                                    .least_flux = kLeastFlux,
                                    .clearance = pixel_clearance(view.camera)})
      .dispatch_threads(split_size.x, split_size.y);

  ImageHandle merged = create(graph, "merged light", size, VK_FORMAT_R32G32B32A32_SFLOAT);
  graph.compute("many light: merge", kernels::many_light_merge_comp)
      .read("split_light", split_light)
      .write("merged", merged)
      .push(glsl::SplitParams{size, tile_size})
      .dispatch_threads(size.x, size.y);
  ImageHandle filtered = create(graph, "filtered light", size, VK_FORMAT_R32G32B32A32_SFLOAT);
  graph.compute("many light: filter", kernels::many_light_paper_filter_comp)
      .read("position", gbuffer.position)
      .read("normal", gbuffer.normal)
      .read("merged", merged)
      .write("filtered", filtered)
      .push(glsl::PaperFilterParams{size, options_.filter_distance * diagonal,
                                    std::cos(glm::radians(options_.filter_angle))})
      .dispatch_threads(size.x, size.y);
  views_ = {{"split-position", split.position},
            {"split-normal", split.normal},
            {"split-indirect", split_light},
            {"merged-indirect", merged},
            {"filtered-indirect", filtered}};
  add_world_views(graph, world, view, views_);
  return {.irradiance = filtered};
}

}  // namespace lightwell
