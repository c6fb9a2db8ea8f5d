// Which parts (primitives of instances, as FlatGeometry lists them) move.
#pragma once

#include <vector>

#include "lightwell/scene.h"
#include "passes/gpu_scene/flatten.h"

namespace lightwell {

// Those that some animation of the scene moves. One a part.
std::vector<bool> list_animated_parts(const Scene& scene, const std::vector<MeshInstance>& instances);

// Those that are elsewhere, or in another pose, in `after` than in `before` (the same instances).
std::vector<bool> list_moved_parts(const std::vector<FlatPart>& parts, const std::vector<MeshInstance>& before,
                                   const std::vector<MeshInstance>& after);

}  // namespace lightwell
