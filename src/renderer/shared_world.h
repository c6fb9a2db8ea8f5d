// The world with the parts that techniques keep of it: what several views share.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "lightwell/renderer.h"
#include "passes/world/world.h"
#include "techniques/technique.h"

namespace lightwell {

class SharedWorld {
 public:
  // Of `options`, those of the world count. Throws InputError as Renderer's constructor does.
  SharedWorld(Device& device, const Scene& scene, const SceneSnapshot& snapshot, const RendererOptions& options);

  World& world() { return world_; }

  // The part that all techniques with this key share (name, preset, options of the world, light covered); made where
  // there is none yet.
  struct Part {
    std::string scope;  // of its histories, as the memory report names them
    std::unique_ptr<TechniqueWorld> technique;
    std::uint64_t recorded = UINT64_MAX;  // index of the last frame that it was recorded in
  };
  Part& find_part(const std::string& key, std::string_view name, const Technique& technique, LightKinds covered);

  // Declares the part's passes, unless this frame has them already.
  static TechniqueWorld* record(Part& part, FrameGraph& graph, WorldFrame& world);

 private:
  World world_;
  std::map<std::string, Part> parts_;
};

}  // namespace lightwell
