// Materials of Wavefront OBJ files.
#pragma once

#include <map>
#include <string>

#include "lightwell/scene.h"

namespace lightwell {

// The material of faces that name none, or one that does not exist: grey, seen from both sides as all OBJ surfaces.
Material plain_material(const std::string& name);

// Reads an MTL library (Kd, Ke, Ni, d, map_Kd, map_Ke with -o, -s, -clamp) and appends its materials to the scene;
// `indices` maps their names to places in scene.materials. Missing files are warnings; a malformed one is an
// InputError. `path` is the MTL file, `subject` the OBJ that names it.
void read_mtl(const std::string& path, const std::string& subject, Scene& scene, std::map<std::string, int>& indices);

}  // namespace lightwell
