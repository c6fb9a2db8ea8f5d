#include "renderer/shared_world.h"

#include "renderer/options.h"

namespace lightwell {

SharedWorld::SharedWorld(Device& device, const Scene& scene, const SceneSnapshot& snapshot,
                         const RendererOptions& options)
    : world_(device, scene, snapshot,
             {.shadow_map_size = static_cast<std::uint32_t>(options.shadow_map_size),
              .tracing = fixed_tracing(device, options.tracing),
              .grid_bounds = options.grid_bounds}) {}

std::shared_ptr<SharedWorld::Part> SharedWorld::find_part(const std::string& key, std::string_view name,
                                                          const Technique& technique, LightKinds covered) {
  std::erase_if(parts_, [](const auto& entry) { return entry.second.expired(); });
  const auto found = parts_.find(key);
  if (found != parts_.end()) return found->second.lock();
  auto part = std::make_shared<Part>();
  part->scope = name;
  if (++part_count_ > 1) part->scope.append(" ").append(std::to_string(part_count_));
  part->scope.append(": ");
  part->technique = technique.create_world(covered);
  parts_[key] = part;
  return part;
}

TechniqueWorld* SharedWorld::record(Part& part, FrameGraph& graph, WorldFrame& world) {
  if (part.technique && part.declared != world.index) {
    const FrameGraph::Scope scope = graph.enter(part.scope, world.is_cut);
    part.technique->record_world(graph, world);
    part.declared = world.index;
  }
  return part.technique.get();
}

}  // namespace lightwell
