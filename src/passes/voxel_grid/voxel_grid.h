// Fits the one voxel grid type to a scene.
#pragma once

#include <cstdint>
#include <optional>

#include "lightwell/scene.h"
#include "passes/voxel_grid/voxel_grid_types.h"

namespace lightwell {

using VoxelGrid = glsl::VoxelGrid;

// resolution^3 cubic cells. The longest axis of `bounds` spans the resolution but for a margin of 1/256 of a cell at
// both ends, so that surfaces on the bounds lie inside the outermost cells; the shorter axes are centred, and surfaces
// on their bounds lie in the cell on the inner side where bounds and cell walls coincide. Bounds without extent get a
// grid of 1 mm.
VoxelGrid fit_voxel_grid(const Bounds& bounds, std::uint32_t resolution);

// The grid of a scene in motion, `last` being that of the frame before: it stays where it is as long as it holds
// `bounds` and is not much too large, for cells that move make void all that is kept by cell. Once things have left it,
// the next one gets a tenth to spare on every side. Without `last`: fitted.
VoxelGrid keep_voxel_grid(const std::optional<VoxelGrid>& last, const Bounds& bounds, std::uint32_t resolution);

// Whether the cells are the same places.
bool is_same_grid(const VoxelGrid& a, const VoxelGrid& b);

// World position of the upper corner.
glm::vec3 upper_corner(const VoxelGrid& grid);

}  // namespace lightwell
