#include "passes/emitters/emitter_table.h"

#include "graph/linear_dispatch.h"
#include "kernels/passes/emitters/emitters_list.comp.h"
#include "kernels/passes/emitters/emitters_sum.comp.h"
#include "passes/emitters/emitters_params.h"
#include "passes/emitters/emitters_types.h"

namespace lightwell {

EmitterTable::Frame EmitterTable::record(FrameGraph& graph, const GpuScene::Frame& scene) {
  const std::uint32_t count = scene.emissive_triangle_count;
  const std::uint32_t group_count = (count + glsl::kEmitterGroup - 1) / glsl::kEmitterGroup;
  Frame frame;
  frame.look_up = (scene.texture_arrays >> 4) != 0 || scene.opaque_triangle_count < scene.triangle_count;
  bool fresh[2];
  frame.emitters = graph.history_buffer("emitters", count, sizeof(glsl::EmissiveTriangle), fresh[0]);
  frame.groups = graph.history_buffer("emitter groups", group_count + 1, sizeof(glsl::EmitterGroup), fresh[1]);
  const bool changed =
      geometry_changed(revisions_, scene.revisions) || revisions_.materials != scene.revisions.materials;
  if (count == 0 || !(changed || fresh[0] || fresh[1])) return frame;
  graph.on_recorded([this, revisions = scene.revisions] { revisions_ = revisions; });

  const glsl::EmitterParams params{count};
  dispatch_linear(graph.compute("list emitters", kernels::emitters_emitters_list_comp)
                      .bind(scene.set)
                      .read("emissive_triangles", scene.emissive_triangles)
                      .write("emitters", frame.emitters)
                      .push(params),
                  count);
  for (const std::uint32_t stage : {0u, 1u}) {
    ComputePass& pass = graph.compute("sum emitters", kernels::emitters_emitters_sum_comp)
                            .write("emitters", frame.emitters)
                            .write("groups", frame.groups)
                            .constant("kStage", stage)
                            .push(params);
    dispatch_linear(pass, stage == 0 ? group_count : 1);
  }
  return frame;
}

}  // namespace lightwell
