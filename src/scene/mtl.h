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

// Reads an MTL library: Kd, Ke, Ni, d, Tr, Pr, Pm, map_Kd, map_Ke, map_d, map_Bump and norm, maps with -o, -s, -clamp,
// -bm and -imfchan. A missing file and all that is malformed or not shown are warnings. Throws ForbiddenFile.
void read_mtl(const std::string& path, MtlMaterials& materials);

}  // namespace lightwell
