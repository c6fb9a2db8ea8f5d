// Textures of a scene that is being read.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "lightwell/scene.h"
#include "scene/memory_budget.h"
#include "scene/scene_files.h"

namespace lightwell {

class TextureLoader {
 public:
  // `scene` outlives the loader. `subject` names the scene's file.
  TextureLoader(Scene& scene, const std::string& subject);

  // Decodes an image file held in memory and appends it to scene.textures. Returns its index, or -1 after a warning
  // that names `image`: its file is damaged or of a kind that cannot be read. Throws InputError if the scene's textures
  // become too many or, together, too large; that is known before one is decoded.
  int add(const std::string& image, const std::string& name, std::span<const std::uint8_t> bytes);

  // The same in two steps. Nothing, or InputError, as above.
  std::optional<Texture> decode(const std::string& image, const std::string& name, std::span<const std::uint8_t> bytes);
  int append(Texture texture);

  // The same of a file that is there, after a warning also if it cannot be read. Throw ForbiddenFile as well.
  int add_file(const SceneFiles& files, const std::string& path, const std::string& name);
  std::optional<Texture> decode_file(const SceneFiles& files, const std::string& path, const std::string& name);

  // Memory for `count` texels of a texture that is made of others. Throws InputError.
  void charge(std::uint64_t count) { budget_.charge(count, 4); }

 private:
  Scene& scene_;
  std::string subject_;
  MemoryBudget budget_;
};

}  // namespace lightwell
