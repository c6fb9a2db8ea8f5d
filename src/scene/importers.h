// The importers behind load_scene(), one a file format, and what they share.
#pragma once

#include <string>

#include "lightwell/scene.h"
#include "scene/scene_files.h"

namespace lightwell {

// Each throws InputError. The result still needs validate(): numbers may be infinite.
Scene import_gltf(const std::string& path, const SceneFiles& files);
Scene import_obj(const std::string& path, const SceneFiles& files);
Scene import_ply(const std::string& path, const SceneFiles& files);

// Puts the scene under a root node that turns the file's units and up axis into metres and +Y. Intensities stay W/sr.
void apply_import_options(Scene& scene, const ImportOptions& options);

}  // namespace lightwell
