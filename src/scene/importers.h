// The importers behind load_scene(), one a file format, and what they share.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "lightwell/scene.h"

namespace lightwell {

// Each throws InputError. The result still needs validate(): numbers may be infinite.
Scene import_gltf(const std::string& path);
Scene import_obj(const std::string& path);
Scene import_ply(const std::string& path);

// Decodes an image file held in memory and appends it to scene.textures. Returns its index. Throws InputError naming
// `subject`, also when the scene's textures together become too large.
int add_texture(Scene& scene, const std::string& subject, const std::string& name, std::span<const std::uint8_t> bytes);

// Puts the scene under a root node that turns the file's units and up axis into metres and +Y. Intensities stay W/sr.
void apply_import_options(Scene& scene, const ImportOptions& options);

}  // namespace lightwell
