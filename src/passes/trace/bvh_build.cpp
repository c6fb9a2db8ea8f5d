#include "passes/trace/bvh_build.h"

#include <algorithm>
#include <string>
#include <utility>

#include "graph/linear_dispatch.h"
#include "kernels/passes/trace/bvh_advance.comp.h"
#include "kernels/passes/trace/bvh_bounds.comp.h"
#include "kernels/passes/trace/bvh_codes.comp.h"
#include "kernels/passes/trace/bvh_collapse.comp.h"
#include "kernels/passes/trace/bvh_collapse_top.comp.h"
#include "kernels/passes/trace/bvh_count.comp.h"
#include "kernels/passes/trace/bvh_leaf_nodes.comp.h"
#include "kernels/passes/trace/bvh_levels.comp.h"
#include "kernels/passes/trace/bvh_link.comp.h"
#include "kernels/passes/trace/bvh_merge.comp.h"
#include "kernels/passes/trace/bvh_refit.comp.h"
#include "kernels/passes/trace/bvh_refit_top.comp.h"
#include "kernels/passes/trace/bvh_search.comp.h"
#include "kernels/passes/trace/bvh_start.comp.h"
#include "kernels/passes/trace/bvh_top.comp.h"
#include "kernels/passes/trace/bvh_triangles.comp.h"
#include "lightwell/error.h"
#include "passes/sort/sort.h"
#include "passes/sort/sort_types.h"
#include "passes/trace/bvh_params.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kWord = sizeof(std::uint32_t);
constexpr std::uint32_t kWide = sizeof(glm::uvec4);

std::uint32_t divide_up(std::uint32_t a, std::uint32_t b) {
  return (a + b - 1) / b;
}

// Rounds of merging before one workgroup takes over. So many pair neighbours that the clusters become few in any case;
// five times as many before them follow likeness: each usually merges a fifth to a third of the clusters. Pairing
// whatever is next to each other too early makes a hierarchy that takes three times as many steps.
struct Rounds {
  std::uint32_t free = 0;
  std::uint32_t forced = 0;
  std::uint32_t all() const { return free + forced; }
};

Rounds rounds_for(std::uint32_t triangles) {
  constexpr std::uint32_t kMostForced = (glsl::kBvhMaximumRounds - glsl::kBvhTopRounds) / 6;
  constexpr std::uint32_t kMostTriangles = glsl::kBvhTopClusters << kMostForced;
  static_assert(kMostTriangles <= glsl::kBvhSlotMask);
  if (triangles > kMostTriangles)
    throw InputError("scene", std::to_string(triangles) + " triangles; our own hierarchy for ray tracing takes " +
                                  std::to_string(kMostTriangles));
  Rounds rounds;
  while ((std::uint64_t{glsl::kBvhTopClusters} << rounds.forced) < triangles) ++rounds.forced;
  rounds.free = 5 * rounds.forced;
  return rounds;
}

// What lives only while one hierarchy is built.
struct Scratch {
  Scratch(FrameGraph& graph, std::uint32_t n)
      : state(graph.create_buffer("bvh state", glsl::kBvhStateWords, kWord)),
        keys(graph.create_buffer("bvh keys", n, sizeof(glm::uvec2))),
        blocks(graph.create_buffer("bvh blocks", divide_up(n, glsl::kBvhPairBlock), sizeof(glm::uvec2))),
        lows(graph.create_buffer("bvh binary lows", 2 * n, kWide)),
        highs(graph.create_buffer("bvh binary highs", 2 * n, kWide)),
        sizes(graph.create_buffer("bvh binary sizes", n, kWord)),
        clusters(graph.create_buffer("bvh clusters", 2 * n, kWord)),
        partners(graph.create_buffer("bvh partners", n, kWord)),
        marks(graph.create_buffer("bvh marks", n, kWord)),
        firsts(graph.create_buffer("bvh first slots", 2 * n, kWord)),
        children(graph.create_buffer("bvh children", n, kWide)) {}

  BufferHandle state, keys, blocks, lows, highs, sizes, clusters, partners, marks, firsts, children;
};

class Builder {
 public:
  Builder(FrameGraph& graph, const GpuScene::Frame& scene, const BvhPart& part, BvhBuffers& buffers)
      : graph_(graph),
        scene_(scene),
        part_(part),
        buffers_(buffers),
        rounds_(rounds_for(part.count)),
        params_{part.count,
                part.gap_first,
                part.gap_count,
                part.node_first,
                part.slot_first,
                part.root_word,
                rounds_.all(),
                0,
                0} {}

  void build();
  void refit();

 private:
  void sort_triangles(Scratch& s);
  void merge_clusters(Scratch& s);
  void collapse(Scratch& s);

  FrameGraph& graph_;
  const GpuScene::Frame& scene_;
  const BvhPart& part_;
  BvhBuffers& buffers_;
  const Rounds rounds_;
  const glsl::BvhParams params_;
};

void Builder::sort_triangles(Scratch& s) {
  graph_.compute("bvh: start", kernels::trace_bvh_start_comp).write("state", s.state).push(params_).dispatch(1);
  dispatch_linear(graph_.compute("bvh: bounds", kernels::trace_bvh_bounds_comp)
                      .bind(scene_.set)
                      .write("state", s.state)
                      .push(params_),
                  divide_up(part_.count, glsl::kBvhBoundsBlock));
  dispatch_linear(graph_.compute("bvh: codes", kernels::trace_bvh_codes_comp)
                      .bind(scene_.set)
                      .read("state", s.state)
                      .write("keys", s.keys)
                      .push(params_),
                  part_.count);
  s.keys = record_sort(graph_, "bvh: sort", s.keys, part_.count, glsl::kBvhCodeBits);
}

// Parallel locally-ordered clustering (Meister and Bittner 2018).
void Builder::merge_clusters(Scratch& s) {
  dispatch_linear(graph_.compute("bvh: leaves", kernels::trace_bvh_leaf_nodes_comp)
                      .bind(scene_.set)
                      .read("keys", s.keys)
                      .write("lows", s.lows)
                      .write("highs", s.highs)
                      .write("clusters", s.clusters)
                      .push(params_),
                  part_.count);
  for (std::uint32_t round = 0; round < rounds_.all(); ++round) {
    glsl::BvhParams params = params_;
    params.round = round;
    params.forced = round < rounds_.free ? 0 : 1;
    graph_.compute("bvh: search", kernels::trace_bvh_search_comp)
        .read("state", s.state)
        .read("lows", s.lows)
        .read("highs", s.highs)
        .read("clusters", s.clusters)
        .write("partners", s.partners)
        .push(params)
        .dispatch_indirect(s.state, glsl::kBvhSearchGroups * kWord);
    graph_.compute("bvh: count", kernels::trace_bvh_count_comp)
        .read("state", s.state)
        .read("partners", s.partners)
        .write("blocks", s.blocks)
        .push(params)
        .dispatch_indirect(s.state, glsl::kBvhCountGroups * kWord);
    graph_.compute("bvh: advance", kernels::trace_bvh_advance_comp)
        .write("blocks", s.blocks)
        .write("state", s.state)
        .push(params)
        .dispatch(1);
    graph_.compute("bvh: merge", kernels::trace_bvh_merge_comp)
        .read("state", s.state)
        .read("partners", s.partners)
        .read("blocks", s.blocks)
        .write("lows", s.lows)
        .write("highs", s.highs)
        .write("sizes", s.sizes)
        .write("clusters", s.clusters)
        .push(params)
        .dispatch_indirect(s.state, glsl::kBvhMergeGroups * kWord);
  }
  graph_.compute("bvh: top", kernels::trace_bvh_top_comp)
      .write("state", s.state)
      .write("lows", s.lows)
      .write("highs", s.highs)
      .write("sizes", s.sizes)
      .write("clusters", s.clusters)
      .push(params_)
      .dispatch(1);
}

void Builder::collapse(Scratch& s) {
  graph_.fill("bvh: clear", s.marks, 0);
  const auto collapse = [&](const KernelCode& kernel, std::uint32_t round) -> ComputePass& {
    glsl::BvhParams params = params_;
    params.round = round;
    return graph_.compute("bvh: collapse", kernel)
        .read("state", s.state)
        .read("lows", s.lows)
        .read("highs", s.highs)
        .read("sizes", s.sizes)
        .write("marks", s.marks)
        .write("firsts", s.firsts)
        .write("children", s.children)
        .write("triangles", buffers_.triangles)
        .push(params);
  };
  collapse(kernels::trace_bvh_collapse_top_comp, 0).dispatch(1);
  for (std::uint32_t round = rounds_.all(); round-- > 0;) {
    collapse(kernels::trace_bvh_collapse_comp, round)
        .dispatch_indirect(s.state, (glsl::kBvhRounds + 4 * round) * kWord);
  }
  const std::uint32_t inner_nodes = part_.count - 1;
  const PrefixSums ranks = record_prefix_sums(graph_, "bvh: add up", s.marks, inner_nodes);
  graph_.compute("bvh: levels", kernels::trace_bvh_levels_comp)
      .read("state", s.state)
      .read("marks", s.marks)
      .read("ranks", ranks.sums)
      .read("blocks", ranks.blocks)
      .write("levels", buffers_.levels)
      .write("nodes", buffers_.nodes)
      .push(params_)
      .dispatch(1);
  dispatch_linear(graph_.compute("bvh: link", kernels::trace_bvh_link_comp)
                      .read("sizes", s.sizes)
                      .read("marks", s.marks)
                      .read("ranks", ranks.sums)
                      .read("blocks", ranks.blocks)
                      .read("firsts", s.firsts)
                      .read("children", s.children)
                      .write("nodes", buffers_.nodes)
                      .push(params_),
                  inner_nodes);
}

void Builder::build() {
  Scratch scratch(graph_, part_.count);
  sort_triangles(scratch);
  merge_clusters(scratch);
  collapse(scratch);
}

void Builder::refit() {
  dispatch_linear(graph_.compute("bvh: triangles", kernels::trace_bvh_triangles_comp)
                      .bind(scene_.set)
                      .write("triangles", buffers_.triangles)
                      .push(params_),
                  part_.count);
  const auto fit = [&](const KernelCode& kernel, std::uint32_t round) -> ComputePass& {
    glsl::BvhParams params = params_;
    params.round = round;
    return graph_.compute("bvh: fit", kernel)
        .read("levels", buffers_.levels)
        .read("triangles", buffers_.triangles)
        .write("nodes", buffers_.nodes)
        .write("node_boxes", buffers_.node_boxes)
        .push(params);
  };
  for (std::uint32_t round = 0; round < rounds_.all(); ++round)
    fit(kernels::trace_bvh_refit_comp, round).dispatch_indirect(buffers_.levels, std::uint64_t{4} * round * kWord);
  fit(kernels::trace_bvh_refit_top_comp, 0).dispatch(1);
}

}  // namespace

std::uint32_t bvh_node_capacity(std::uint32_t triangles) {
  return triangles / 9 * 5 + 5;
}

void record_bvh_build(FrameGraph& graph, const GpuScene::Frame& scene, const BvhPart& part, BvhBuffers& buffers) {
  Builder builder(graph, scene, part, buffers);
  builder.build();
  builder.refit();
}

void record_bvh_refit(FrameGraph& graph, const GpuScene::Frame& scene, const BvhPart& part, BvhBuffers& buffers) {
  Builder(graph, scene, part, buffers).refit();
}

}  // namespace lightwell
