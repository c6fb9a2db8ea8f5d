// Materials of Wavefront OBJ files.
#pragma once

#include <map>
#include <string>

#include "lightwell/scene.h"
#include "scene/scene_files.h"
#include "scene/texture_loader.h"

namespace lightwell {

// The material of faces that name none, or one that does not exist: grey, seen from both sides as all OBJ surfaces.
Material plain_material(const std::string& name);

// The materials that an OBJ file's libraries give.
struct MtlMaterials {
  const std::string& subject;  // the OBJ file
  const SceneFiles& files;
  Scene& scene;  // gets materials and textures
  TextureLoader textures;
  std::map<std::string, int> indices;  // into scene.materials, by name
};

// Reads an MTL library (Kd, Ke, Ni, d, map_Kd, map_Ke with -o, -s, -clamp). A missing file and what is wrong with its
// maps are warnings; a malformed one is an InputError.
void read_mtl(const std::string& path, MtlMaterials& materials);

}  // namespace lightwell
