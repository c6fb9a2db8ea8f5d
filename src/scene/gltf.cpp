// glTF 2.0 importer: Khronos, glTF 2.0 Specification (2021).
#include "scene/gltf_parts.h"
#include "scene/gltf_properties.h"
#include "scene/importers.h"

namespace lightwell {

Scene import_gltf(const std::string& path, const SceneFiles& files) {
  GltfFile file(path, files);
  Scene scene;
  read_gltf_materials(file, scene);
  read_gltf_meshes(file, scene);
  const GltfIndices indices{read_gltf_cameras(file, scene), read_gltf_lights(file, scene)};
  const std::vector<int> nodes = read_gltf_nodes(file, scene, indices);
  read_gltf_skins(file, scene, nodes);
  read_gltf_animations(file, scene, nodes);
  note_gltf_properties(file.document(), file.notes());
  file.notes().log();
  return scene;
}

}  // namespace lightwell
