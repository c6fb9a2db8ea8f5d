#include "techniques/photon_splatting/splat_view.h"

#include <algorithm>

#include "passes/light_paths/light_paths.h"

namespace lightwell {

void describe_splat_view(OptionVisitor& visitor, SplatViewOptions& options) {
  visitor.visit({"tolerance", "How far behind its shadow map's depth a surface is still lit.", "texels",
                 "less: surfaces shadow themselves; more: light comes through walls"},
                options.tolerance, 0.0f, 100.0f);
  visitor.visit(
      {"list-memory", "Memory of the lists of splats by tile; where they need more, fewer count for more.", "MiB", ""},
      options.list_memory, 1, 128);
}

SplatPicture record_splat_picture(FrameGraph& graph, const ViewFrame& view, const PhotonWorld& world,
                                  const SplatViewOptions& options, SplatRules rules,
                                  const std::shared_ptr<bool>& warned) {
  SplatPicture picture{.screen = {.gbuffer = view.gbuffer,
                                  .camera = view.camera,
                                  .camera_buffer = view.camera_buffer,
                                  .sampling = {1u << options.sampling, view.world.index}},
                       .splats = {.splats = world.splats(),
                                  .counts = world.splat_counts(),
                                  .capacity = world.capacity(),
                                  .shadow_atlas = world.shadow_atlas(),
                                  .map_side = world.map_side(),
                                  .maps_per_row = world.maps_per_row()},
                       .lists = {},
                       .rules = rules,
                       .gathered = {},
                       .light = {}};
  picture.rules.kernel = world.options().kernel;
  picture.rules.tolerance = options.tolerance;
  picture.lists = record_splat_lists(graph, picture.screen, picture.splats, rules.estimate,
                                     static_cast<std::uint64_t>(options.list_memory) << 20, warned);
  picture.gathered = record_splat_gather(graph, picture.screen, picture.splats, picture.lists, picture.rules);
  picture.light =
      options.sampling > 0 ? record_splat_spread(graph, picture.screen, picture.gathered) : picture.gathered;
  return picture;
}

void add_splat_views(FrameGraph& graph, const ViewFrame& view, const PhotonWorld& world,
                     const SplatViewOptions& options, const SplatPicture& picture, std::vector<DebugView>& views) {
  SplatScreen screen = picture.screen;
  screen.sampling = {};
  const SplatLists lists = picture.screen.sampling.stride == 1
                               ? picture.lists
                               : record_splat_lists(graph, screen, picture.splats, picture.rules.estimate,
                                                    static_cast<std::uint64_t>(options.list_memory) << 20, nullptr);
  const auto show = [&](std::uint32_t what) {
    return record_splat_gather(graph, screen, picture.splats, lists, picture.rules, what);
  };
  views.push_back(
      {"photon-positions", record_light_point_view(graph, view, world.light_points(), world.light_point_count())});
  views.push_back({"splat-centers", show(glsl::kShowCenters)});
  views.push_back({"overlap", show(glsl::kShowOverlap)});
  // Without stratification the grid of the published picture.
  const std::uint32_t cells = 8u << std::max(world.options().stratify, 1);
  views.push_back(
      {"cell-index", record_splat_cells_view(graph, picture.screen, fit_voxel_grid(view.world.grid_bounds, cells))});
  views.push_back({"shadow-maps", record_shadow_atlas_view(graph, picture.screen, picture.splats)});
}

}  // namespace lightwell
