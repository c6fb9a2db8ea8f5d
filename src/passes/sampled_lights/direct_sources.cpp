#include "passes/sampled_lights/direct_sources.h"

namespace lightwell {

DirectSources find_direct_sources(WorldFrame& world) {
  const EmitterTable::Frame& emitters = world.emitters();
  const GpuEnvironment& environment = world.gpu_environment();
  return {.lights = world.lights.lights,
          .emitters = emitters.emitters,
          .groups = emitters.groups,
          .environment_table = world.environment_table(),
          .environment = world.environment,
          .has_emitters = world.scene.emissive_triangle_count > 0,
          .emitters_look_up = emitters.look_up,
          .environment_kind = environment.kind(),
          .table_size = environment.table_size(),
          .emitter_count = world.scene.emissive_triangle_count,
          .light_count = world.lights.count};
}

ComputePass& read_direct_sources(ComputePass& pass, const DirectSources& sources) {
  return pass.read("environment", sources.environment)
      .read("lights", sources.lights)
      .read("emitters", sources.emitters)
      .read("groups", sources.groups)
      .read("environment_table", sources.environment_table)
      .constant("kEmitters", sources.has_emitters ? 1 : 0)
      .constant("kEmittersLookUp", sources.emitters_look_up ? 1 : 0)
      .constant("kEnvironment", sources.environment_kind);
}

}  // namespace lightwell
