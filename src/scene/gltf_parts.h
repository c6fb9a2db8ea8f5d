// The parts of the glTF importer, in the order in which they run. Each fills its array of the scene, in file order
// (nodes: parents first), and hands on what the later parts need to translate the file's indices.
#pragma once

#include <string>
#include <vector>

#include "lightwell/scene.h"
#include "scene/gltf_file.h"

namespace lightwell {

// Materials, and the textures that they use.
void read_gltf_materials(GltfFile& file, Scene& scene);

void read_gltf_meshes(GltfFile& file, Scene& scene);

// Where the scene has the file's cameras and lights; -1: left out.
struct GltfIndices {
  std::vector<int> cameras;
  std::vector<int> lights;
};

std::vector<int> read_gltf_cameras(GltfFile& file, Scene& scene);

// KHR_lights_punctual.
std::vector<int> read_gltf_lights(GltfFile& file, Scene& scene);

// Nodes, parents first; [i] is the scene's node for the file's node i. Instances of a node's mesh
// (EXT_mesh_gpu_instancing) become nodes below it.
std::vector<int> read_gltf_nodes(GltfFile& file, Scene& scene, const GltfIndices& indices);

void read_gltf_skins(GltfFile& file, Scene& scene, const std::vector<int>& nodes);
void read_gltf_animations(GltfFile& file, Scene& scene, const std::vector<int>& nodes);

}  // namespace lightwell
