// Fits the one voxel grid type to a scene.
#pragma once

#include <cstdint>

#include "lightwell/scene.h"
#include "passes/voxel_grid/voxel_grid_types.h"

namespace lightwell {

using VoxelGrid = glsl::VoxelGrid;

// resolution^3 cubic cells. The longest axis of `bounds` spans the resolution but for a margin of 1/256 of a cell at
// both ends, so that surfaces on the bounds lie inside the outermost cells; the shorter axes are centred, and surfaces
// on their bounds lie in the cell on the inner side where bounds and cell walls coincide. Bounds without extent get a
// grid of 1 mm.
VoxelGrid fit_voxel_grid(const Bounds& bounds, std::uint32_t resolution);

// World position of the upper corner.
glm::vec3 upper_corner(const VoxelGrid& grid);

}  // namespace lightwell
