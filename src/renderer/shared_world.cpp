#include "renderer/shared_world.h"

#include "renderer/options.h"

namespace lightwell {

SharedWorld::SharedWorld(Device& device, const Scene& scene, const SceneSnapshot& snapshot,
                         const RendererOptions& options)
    : world_(device, scene, snapshot,
             {.shadow_map_size = static_cast<std::uint32_t>(options.shadow_map_size),
              .tracing = fixed_tracing(device, options.tracing),
              .grid_bounds = options.grid_bounds}) {}

SharedWorld::Part& SharedWorld::find_part(const std::string& key, std::string_view name, const Technique& technique,
                                          LightKinds covered) {
  const auto [it, added] = parts_.try_emplace(key);
  Part& part = it->second;
  if (!added) return part;
  part.scope = name;
  if (parts_.size() > 1) part.scope.append(" ").append(std::to_string(parts_.size()));
  part.scope.append(": ");
  part.technique = technique.create_world(covered);
  return part;
}

TechniqueWorld* SharedWorld::record(Part& part, FrameGraph& graph, WorldFrame& world) {
  if (part.technique && part.recorded != world.index) {
    const FrameGraph::Scope scope = graph.enter(part.scope, false);
    part.technique->record_world(graph, world);
    part.recorded = world.index;
  }
  return part.technique.get();
}

}  // namespace lightwell
