#include "passes/svo/svo.h"

#include <bit>
#include <string>

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
  BufferHandle list;       // packed cells
  BufferHandle arguments;  // of indirect dispatches
  TriangleTiles tiles;     // where something visits triangles
};

glsl::SvoBuildParams at_depth(const Build& build, std::uint32_t depth) {
  glsl::SvoBuildParams params = build.params;
  params.depth = depth;
  return params;
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
        .push(build.params)
        .render_area(svo.grid.resolution.x, svo.grid.resolution.y)
        .draw(3 * build.scene.triangle_count);
    return;
  }
  visit_triangles(graph, "svo: voxels", kernels::svo_svo_visit_comp, build.scene, build.tiles, [&](ComputePass& pass) {
    pass.write("bits", svo.bits).write("list", build.list).write("counts", svo.counts).push(build.params);
  });
}

void record_coarse_bits(FrameGraph& graph, Svo& svo) {
  const std::uint32_t level = svo.memory.level;
  for (std::uint32_t step = 0; step < coarse_steps(level); ++step) {
    const std::uint64_t target = first_coarse_word(level, step);
    const std::uint32_t side_log2 = level - 2 - std::min(2 * step, level - 2);
    dispatch_linear(graph.compute("svo: coarse bits", kernels::svo_svo_coarse_comp)
                        .constant("kFromBits", step == 0 ? 1 : 0)
                        .read("bits", svo.bits)
                        .write("coarse", svo.coarse)
                        .push(glsl::SvoCoarseParams{
                            side_log2, static_cast<std::uint32_t>(step == 0 ? 0 : first_coarse_word(level, step - 1)),
                            static_cast<std::uint32_t>(target)}),
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
        .push(build.params)
        .dispatch_indirect(build.arguments, glsl::kSvoBrickGroups * kWord);
  graph.compute("svo: list", kernels::svo_svo_relisted_comp)
      .read("counts", svo.counts)
      .write("arguments", build.arguments)
      .dispatch(1);
}

void record_levels(FrameGraph& graph, Build& build) {
  Svo& svo = build.svo;
  BufferHandle places = graph.create_buffer("svo places", svo.memory.list_capacity, kWord);
  for (std::uint32_t depth = 0; depth <= svo.memory.level; ++depth) {
    graph.compute("svo: flag", kernels::svo_svo_flag_comp)
        .write("nodes", svo.nodes)
        .read("list", build.list)
        .write("places", places)
        .write("counts", svo.counts)
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
        .push(at_depth(build, depth))
        .dispatch_indirect(build.arguments, glsl::kSvoNodeGroups * kWord);
  }
}

void record_records(FrameGraph& graph, Build& build) {
  Svo& svo = build.svo;
  graph.fill("svo: records", svo.records, 0);
  visit_triangles(
      graph, "svo: records", kernels::svo_svo_record_comp, build.scene, build.tiles,
      [&](ComputePass& pass) { pass.read("nodes", svo.nodes).write("records", svo.records).push(build.params); });
}

SetHandle create_svo_set(FrameGraph& graph, const Svo& svo, float epsilon) {
  const glsl::SvoFrame frame{svo.grid, svo.memory.level, epsilon, 0, 0};
  ResourceSet set{
      .name = "svo",
      .number = 3,
      .members = {{.binding = "svo_frame", .buffer = graph.upload<glsl::SvoFrame>("svo frame", {&frame, 1})},
                  {.binding = "svo_bits", .buffer = svo.bits},
                  {.binding = "svo_coarse", .buffer = svo.coarse},
                  {.binding = "svo_counts", .buffer = svo.counts}},
      .constants = {{"kSvoFine", svo.memory.level >= kFineLevel ? 1u : 0u}}};
  if (svo.nodes) set.members.push_back({.binding = "svo_nodes", .buffer = svo.nodes});
  return graph.create_set(std::move(set));
}

}  // namespace

Svo record_svo(FrameGraph& graph, const GpuScene::Frame& scene, const Bounds& bounds, const SvoSettings& settings,
               bool unchanged) {
  LW_ASSERT(std::has_single_bit(settings.resolution), "resolution " + std::to_string(settings.resolution));
  LW_ASSERT(settings.tree || !settings.records, "records belong to the leaves of a tree");
  Svo svo;
  svo.memory = divide_svo_memory(static_cast<std::uint32_t>(std::countr_zero(settings.resolution)), settings.budget,
                                 graph.descriptor_range(), settings.records);
  svo.grid = fit_voxel_grid(bounds, 1u << svo.memory.level);

  bool build = !unchanged;
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
                 .params = {svo.grid, scene.triangle_count, svo.memory.level, 0, svo.memory.list_capacity,
                            svo.memory.node_tiles, settings.records ? 1u : 0u},
                 .list = graph.create_buffer("svo list", svo.memory.list_capacity, kWord),
                 .arguments = graph.create_buffer("svo arguments", glsl::kSvoArgumentWords, kWord),
                 .tiles = {}};
    if (settings.voxels == SvoVoxels::kConservative || settings.records)
      passes.tiles =
          record_triangle_tiles(graph, "svo: tiles", scene, all_triangles(scene), svo.grid, svo.memory.triangle_tiles);
    record_voxels(graph, passes);
    record_coarse_bits(graph, svo);
    if (settings.tree) {
      record_start(graph, passes);
      record_levels(graph, passes);
      if (settings.records) record_records(graph, passes);
    }
  }
  svo.set = create_svo_set(graph, svo, settings.epsilon);
  return svo;
}

}  // namespace lightwell
