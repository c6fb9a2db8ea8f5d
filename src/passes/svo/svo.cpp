#include "passes/svo/svo.h"

#include <bit>
#include <string>
#include <vector>

#include "graph/linear_dispatch.h"
#include "kernels/passes/svo/svo_advance.comp.h"
#include "kernels/passes/svo/svo_allocate.comp.h"
#include "kernels/passes/svo/svo_coarse.comp.h"
#include "kernels/passes/svo/svo_flag.comp.h"
#include "kernels/passes/svo/svo_rasterise.frag.h"
#include "kernels/passes/svo/svo_rasterise.vert.h"
#include "kernels/passes/svo/svo_record.comp.h"
#include "kernels/passes/svo/svo_relist.comp.h"
#include "kernels/passes/svo/svo_relisted.comp.h"
#include "kernels/passes/svo/svo_start.comp.h"
#include "kernels/passes/svo/svo_visit.comp.h"
#include "lightwell/error.h"
#include "passes/svo/svo_params.h"
#include "passes/voxelize/voxelize.h"

namespace lightwell {
namespace {

constexpr std::uint64_t kWord = sizeof(std::uint32_t);

// From this level on rays through the bits look for boxes of 16 and 32 cells, too.
constexpr std::uint32_t kFineLevel = 10;

// What the passes of one build hand on.
struct Build {
  const GpuScene::Frame& scene;
  const SvoSettings& settings;
  Svo& svo;
  glsl::SvoBuildParams params;
  BufferHandle windows;    // ivec4 a level
  BufferHandle list;       // entries of svo_windows.glsl
  BufferHandle arguments;  // of indirect dispatches
  TriangleTiles tiles;     // of the level voxelised last, where something visits triangles

  std::uint32_t several() const { return svo.memory.level_count > 1 ? 1 : 0; }
};

glsl::SvoBuildParams at_depth(const Build& build, std::uint32_t depth) {
  glsl::SvoBuildParams params = build.params;
  params.depth = depth;
  return params;
}

TriangleTiles make_tiles(FrameGraph& graph, const Build& build) {
  return record_triangle_tiles(graph, "svo: tiles", build.scene, all_triangles(build.scene), build.params.grid,
                               build.svo.memory.triangle_tiles);
}

void record_voxels(FrameGraph& graph, Build& build) {
  Svo& svo = build.svo;
  graph.fill("svo: clear", svo.bits, 0);
  graph.fill("svo: clear", svo.counts, 0);
  if (build.settings.voxels == SvoVoxels::kRasterised) {
    graph.raster("svo: voxels", kernels::svo_svo_rasterise_vert, kernels::svo_svo_rasterise_frag, {})
        .bind(build.scene.set)
        .write("bits", svo.bits)
        .write("list", build.list)
        .write("counts", svo.counts)
        .read("windows", build.windows)
        .constant("kSeveralLevels", build.several())
        .push(build.params)
        .render_area(svo.grid.resolution.x, svo.grid.resolution.y)
        .draw(3 * build.scene.triangle_count);
    return;
  }
  for (std::uint32_t level = 0; level < svo.memory.level_count; ++level) {
    build.params.grid = level_grid(svo.levels, level);
    build.params.voxel_level = level;
    build.tiles = make_tiles(graph, build);
    visit_triangles(graph, "svo: voxels", kernels::svo_svo_visit_comp, build.scene, build.tiles,
                    [&](ComputePass& pass) {
                      pass.write("bits", svo.bits)
                          .write("list", build.list)
                          .write("counts", svo.counts)
                          .read("windows", build.windows)
                          .constant("kSeveralLevels", build.several())
                          .push(build.params);
                    });
  }
}

void record_coarse_bits(FrameGraph& graph, Svo& svo, std::uint32_t number) {
  const std::uint32_t level = svo.memory.level;
  const std::uint64_t first_bit_word = svo.memory.bit_words / svo.memory.level_count * number;
  const std::uint64_t first_word = svo.memory.coarse_words / svo.memory.level_count * number;
  for (std::uint32_t step = 0; step < coarse_steps(level); ++step) {
    const std::uint64_t source = step == 0 ? first_bit_word : first_word + first_coarse_word(level, step - 1);
    const std::uint64_t target = first_coarse_word(level, step);
    const std::uint32_t side_log2 = level - 2 - std::min(2 * step, level - 2);
    dispatch_linear(graph.compute("svo: coarse bits", kernels::svo_svo_coarse_comp)
                        .constant("kFromBits", step == 0 ? 1 : 0)
                        .read("bits", svo.bits)
                        .write("coarse", svo.coarse)
                        .push(glsl::SvoCoarseParams{side_log2, static_cast<std::uint32_t>(source),
                                                    static_cast<std::uint32_t>(first_word + target)}),
                    (first_coarse_word(level, step + 1) - target) / 2);
  }
}

// The root and the list that the tree is built from.
void record_start(FrameGraph& graph, Build& build) {
  Svo& svo = build.svo;
  graph.compute("svo: list", kernels::svo_svo_start_comp)
      .write("nodes", svo.nodes)
      .write("counts", svo.counts)
      .write("arguments", build.arguments)
      .push(build.params)
      .dispatch(1);
  for (const std::uint32_t write : {0u, 1u})
    graph.compute("svo: coarser list", kernels::svo_svo_relist_comp)
        .constant("kWrite", write)
        .read("bits", svo.bits)
        .write("list", build.list)
        .write("counts", svo.counts)
        .read("windows", build.windows)
        .constant("kSeveralLevels", build.several())
        .push(build.params)
        .dispatch_indirect(build.arguments, glsl::kSvoBrickGroups * kWord);
  graph.compute("svo: list", kernels::svo_svo_relisted_comp)
      .read("counts", svo.counts)
      .write("arguments", build.arguments)
      .dispatch(1);
}

void record_depths(FrameGraph& graph, Build& build) {
  Svo& svo = build.svo;
  BufferHandle places = graph.create_buffer("svo places", svo.memory.list_capacity, kWord);
  for (std::uint32_t depth = 0; depth < svo.memory.level + svo.memory.level_count; ++depth) {
    graph.compute("svo: flag", kernels::svo_svo_flag_comp)
        .write("nodes", svo.nodes)
        .read("list", build.list)
        .write("places", places)
        .write("counts", svo.counts)
        .read("windows", build.windows)
        .constant("kSeveralLevels", build.several())
        .push(at_depth(build, depth))
        .dispatch_indirect(build.arguments, glsl::kSvoListGroups * kWord);
    graph.compute("svo: advance", kernels::svo_svo_advance_comp)
        .write("counts", svo.counts)
        .write("arguments", build.arguments)
        .push(at_depth(build, depth))
        .dispatch(1);
    graph.compute("svo: allocate", kernels::svo_svo_allocate_comp)
        .write("nodes", svo.nodes)
        .write("counts", svo.counts)
        .read("windows", build.windows)
        .constant("kSeveralLevels", build.several())
        .push(at_depth(build, depth))
        .dispatch_indirect(build.arguments, glsl::kSvoNodeGroups * kWord);
  }
}

void record_records(FrameGraph& graph, Build& build) {
  Svo& svo = build.svo;
  if (build.settings.voxels == SvoVoxels::kRasterised) build.tiles = make_tiles(graph, build);
  graph.fill("svo: records", svo.records, 0);
  visit_triangles(
      graph, "svo: records", kernels::svo_svo_record_comp, build.scene, build.tiles,
      [&](ComputePass& pass) { pass.read("nodes", svo.nodes).write("records", svo.records).push(build.params); });
}

BufferHandle upload_windows(FrameGraph& graph, const Svo& svo) {
  std::vector<glm::ivec4> windows;
  for (std::uint32_t level = 0; level < svo.memory.level_count; ++level)
    windows.emplace_back(svo.levels.lower[level], 0);
  return graph.upload<glm::ivec4>("svo windows", windows);
}

SetHandle create_svo_set(FrameGraph& graph, const Svo& svo, BufferHandle windows, float epsilon) {
  const glsl::SvoFrame frame{
      .place = center_corner(svo.levels),
      .cell_size = svo.levels.levels.cell_size,
      .center = svo.levels.levels.center,
      .level = svo.memory.level,
      .epsilon = epsilon,
      .coarse_words = static_cast<std::uint32_t>(svo.memory.coarse_words / svo.memory.level_count),
      .unused_0 = 0,
      .unused_1 = 0};
  ResourceSet set{
      .name = "svo",
      .number = 3,
      .members = {{.binding = "svo_frame", .buffer = graph.upload<glsl::SvoFrame>("svo frame", {&frame, 1})},
                  {.binding = "svo_bits", .buffer = svo.bits},
                  {.binding = "svo_coarse", .buffer = svo.coarse},
                  {.binding = "svo_counts", .buffer = svo.counts},
                  {.binding = "svo_windows", .buffer = windows}},
      .constants = {{"kSvoFine", svo.memory.level >= kFineLevel ? 1u : 0u}, {"kSvoLevels", svo.memory.level_count}}};
  if (svo.nodes) set.members.push_back({.binding = "svo_nodes", .buffer = svo.nodes});
  return graph.create_set(std::move(set));
}

// As fine as asked for, or as the memory holds.
void fit_levels(const Bounds& bounds, const SvoSettings& settings, const SvoLevels* last,
                std::uint64_t descriptor_range, Svo& svo) {
  auto level = static_cast<std::uint32_t>(std::countr_zero(settings.resolution));
  for (bool fits = false; !fits; level = svo.memory.level) {
    svo.levels = keep_svo_levels(last, bounds, settings.focus, 1u << level, settings.finest_cell);
    svo.memory = divide_svo_memory(level, svo.levels.levels.count, settings.budget, descriptor_range, settings.records);
    fits = svo.memory.level == level;
  }
  svo.grid = level_grid(svo.levels, svo.memory.level_count - 1);
}

}  // namespace

Svo record_svo(FrameGraph& graph, const GpuScene::Frame& scene, const Bounds& bounds, const SvoSettings& settings,
               bool unchanged, const SvoLevels* last) {
  LW_ASSERT(std::has_single_bit(settings.resolution), "resolution " + std::to_string(settings.resolution));
  LW_ASSERT(settings.tree || !settings.records, "records belong to the leaves of a tree");
  LW_ASSERT(settings.finest_cell == 0.0f || (settings.voxels == SvoVoxels::kConservative && !settings.records),
            "levels of what is rasterised or recorded");
  Svo svo;
  fit_levels(bounds, settings, last, graph.descriptor_range(), svo);
  const BufferHandle windows = upload_windows(graph, svo);

  const bool same_levels = last != nullptr ? is_same(*last, svo.levels) : svo.memory.level_count == 1;
  bool build = !unchanged || !same_levels;
  const auto keep = [&](const char* name, std::uint64_t count, std::uint32_t stride) {
    bool fresh = false;
    const BufferHandle buffer = graph.history_buffer(name, count, stride, fresh);
    build = build || fresh;
    return buffer;
  };
  svo.bits = keep("svo bits", svo.memory.bit_words, kWord);
  svo.coarse = keep("svo coarse bits", svo.memory.coarse_words, kWord);
  svo.counts = keep("svo counts", glsl::kSvoCountWords, kWord);
  if (settings.tree) svo.nodes = keep("svo nodes", 8 * std::uint64_t{svo.memory.node_tiles}, sizeof(glm::uvec4));
  if (settings.records) svo.records = keep("svo records", svo.memory.list_capacity, sizeof(glsl::SvoRecord));

  if (build) {
    Build passes{.scene = scene,
                 .settings = settings,
                 .svo = svo,
                 .params = {.grid = svo.grid,
                            .voxel_level = 0,
                            .level_count = svo.memory.level_count,
                            .triangle_count = scene.triangle_count,
                            .level = svo.memory.level,
                            .depth = 0,
                            .list_capacity = svo.memory.list_capacity,
                            .node_tiles = svo.memory.node_tiles,
                            .records = settings.records ? 1u : 0u},
                 .windows = windows,
                 .list = graph.create_buffer("svo list", svo.memory.list_capacity, kWord),
                 .arguments = graph.create_buffer("svo arguments", glsl::kSvoArgumentWords, kWord),
                 .tiles = {}};
    record_voxels(graph, passes);
    for (std::uint32_t level = 0; level < svo.memory.level_count; ++level) record_coarse_bits(graph, svo, level);
    if (settings.tree) {
      record_start(graph, passes);
      record_depths(graph, passes);
      if (settings.records) record_records(graph, passes);
    }
  }
  svo.set = create_svo_set(graph, svo, windows, settings.epsilon);
  return svo;
}

}  // namespace lightwell
