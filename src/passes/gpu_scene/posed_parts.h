// The pose of all instances as the GPU wants it.
#pragma once

#include <vector>

#include "lightwell/scene.h"
#include "passes/gpu_scene/flatten.h"
#include "passes/gpu_scene/world_vertices_params.h"

namespace lightwell {

struct PosedParts {
  std::vector<glsl::Part> parts;
  std::vector<glsl::Joint> joints;  // of instances with a skinned part, instance by instance
  std::vector<glsl::Morph> morphs;  // whose weights are not 0, part by part
};

PosedParts pose_parts(const std::vector<FlatPart>& parts, const std::vector<MeshInstance>& instances);

// Whether the instance's joints place the part, instead of to_world.
bool is_skinned(const FlatPart& part, const MeshInstance& instance);

}  // namespace lightwell
