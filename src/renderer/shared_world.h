// The world with the parts that techniques keep of it: what several views share.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "lightwell/renderer.h"
#include "passes/world/world.h"
#include "techniques/technique.h"

namespace lightwell {

class SharedWorld {
 public:
  // Of `options`, those of the world count. Throws InputError as Renderer's constructor does.
  SharedWorld(Device& device, const Scene& scene, const SceneSnapshot& snapshot, const RendererOptions& options);

  World& world() { return world_; }

  struct Part {
    std::string scope;                          // of its histories, as the memory report names them
    std::unique_ptr<TechniqueWorld> technique;  // null: the technique keeps nothing of the world
    std::uint64_t declared = UINT64_MAX;        // index of the last frame that has its passes
  };
  // The part that all techniques with this key (world_key()) share; made where there is none. It goes with the last
  // view that holds it.
  std::shared_ptr<Part> find_part(const std::string& key, std::string_view name, const Technique& technique,
                                  LightKinds covered);

  // Declares the part's passes, unless this frame has them already.
  static TechniqueWorld* record(Part& part, FrameGraph& graph, WorldFrame& world);

 private:
  World world_;
  std::map<std::string, std::weak_ptr<Part>> parts_;  // by key
  std::uint64_t part_count_ = 0;                      // made so far: none takes over the histories of another
};

}  // namespace lightwell
