// Textures of a scene that is being read.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "lightwell/scene.h"
#include "scene/memory_budget.h"

namespace lightwell {

class TextureLoader {
 public:
  // `scene` outlives the loader. `subject` names the scene's file.
  TextureLoader(Scene& scene, const std::string& subject);

  // Decodes an image file held in memory and appends it to scene.textures. Returns its index, or -1 after a warning
  // that names `image`: its file is damaged or of a kind that cannot be read. Throws InputError if the scene's textures
  // become too many or, together, too large; that is known before one is decoded.
  int add(const std::string& image, const std::string& name, std::span<const std::uint8_t> bytes);

 private:
  Scene& scene_;
  std::string subject_;
  MemoryBudget budget_;
};

}  // namespace lightwell
