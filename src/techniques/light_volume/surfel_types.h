// Buffers and parameters of the surfel solver, as host and kernels see them. All lengths are in cells, measured from
// the grid's lower corner, unless a name says otherwise.
#ifndef LIGHTWELL_LIGHT_VOLUME_SURFEL_TYPES_H
#define LIGHTWELL_LIGHT_VOLUME_SURFEL_TYPES_H

#include "passes/voxel_grid/voxel_grid_types.h"

// The surface inside one cell whose normals have their largest component along one of six directions (as in
// passes/voxelize/voxelize_types.h). A flat patch: the plane through `position` perpendicular to `normal`, cut by
// the bounds of the real surface.
//   bounds: corners relative to the cell, in 1/1023, 10 bits each
//   emission: times `area` it is the power of all layers of the surface
#define LW_SURFEL(MEMBER)                                           \
  MEMBER(vec3, position)                                            \
  MEMBER(uint, key)      /* 8 * cell index + direction */           \
  MEMBER(vec3, normal)   /* unit; 0: nothing is left of it */       \
  MEMBER(float, opacity) /* part of the patch that is there */      \
  MEMBER(vec3, emission) /* radiance, W/(sr m^2) */                 \
  MEMBER(uint, albedo)   /* see pack_albedo() */                    \
  MEMBER(uint, bounds_low)                                          \
  MEMBER(uint, bounds_high)                                         \
  MEMBER(uint, is_front) /* 1: a triangle's front; 0: only backs */ \
  MEMBER(float, area)    /* of the part that is there, cells^2 */
LW_STRUCT(Surfel, LW_SURFEL)

// Sums over the pieces of triangles in a surfel, in fixed point: integer additions commute, so the result does not
// depend on the order of the triangles. Words of 4 bytes:
LW_CONSTANT(uint, kSumWeight, 0)       // area (cells^2) * coverage
LW_CONSTANT(uint, kSumPosition, 1)     // 3 words: weight * position relative to the cell, in [0,1]
LW_CONSTANT(uint, kSumNormal, 4)       // 3 words, signed: weight * normal
LW_CONSTANT(uint, kSumAlbedo, 7)       // 3 words: weight * albedo
LW_CONSTANT(uint, kSumEmission, 10)    // 3 words: weight * emission / the scene's largest emission
LW_CONSTANT(uint, kSumBoundsLow, 13)   // 3 words: maximum of 1 - corner, in 1/2^16
LW_CONSTANT(uint, kSumBoundsHigh, 16)  // 3 words: maximum of corner, in 1/2^16
LW_CONSTANT(uint, kSumWords, 20)
// One cell^2 is 2^20: a piece of 1e-3 x 1e-3 cells still counts, and signed sums hold 2048 cells^2. A surfel that has
// gathered half of that takes no more.
LW_CONSTANT(float, kSumScale, 1048576.0f)
LW_CONSTANT(uint, kSumLimit, 1 << 30)

// Where a cell's surfels are: base << 12 | alive << 6 | stored. Bit d of `stored`: direction d has a slot, at base +
// the number of stored directions before d; bit d of `alive`: there is a surface in it.
LW_CONSTANT(uint, kTableBaseShift, 12)
LW_CONSTANT(uint, kTableAliveShift, 6)
LW_CONSTANT(uint, kSurfelCapacityLimit, 1 << 20)

// Words of the buffer `counts`.
LW_CONSTANT(uint, kCountSurfels, 0)
LW_CONSTANT(uint, kCountUnused, 1)    // capacity - the first slot that a brick could not get whole; 0: all did
LW_CONSTANT(uint, kCountLost, 2)      // surfels for which there was no room
LW_CONSTANT(uint, kCountEmitters, 3)  // surfels that emit
LW_CONSTANT(uint, kCountGroups, 4)    // 3 words: dispatch of one invocation a surfel
LW_CONSTANT(uint, kCountWords, 8)

// What a surfel sees along one of its rays. Link k of surfel s is word k * capacity + s: a slot and flags, or a
// direction that leads out of the grid.
LW_CONSTANT(uint, kLinkSlot, 0x000fffffu)     // mask
LW_CONSTANT(uint, kLinkEmits, 0x20000000u)    // what the surfel there emits comes along the link
LW_CONSTANT(uint, kLinkBack, 0x40000000u)     // the surfel there is made of triangles' backs
LW_CONSTANT(uint, kLinkEscaped, 0x80000000u)  // no surfel: the low 30 bits hold the direction, octahedral
LW_CONSTANT(uint, kLinkNone, 0xffffffffu)     // not traced yet

// An emitting surfel. All of them, in order of their cells, make up a table of the power up to and with each.
#define LW_SURFEL_EMITTER(MEMBER) MEMBER(uint, slot) MEMBER(float, power_so_far)
LW_STRUCT(SurfelEmitter, LW_SURFEL_EMITTER)

// Points on emitters that every surfel sends shadow rays to, one bit each.
LW_CONSTANT(uint, kEmitterSamples, 32)

// What a surfel's links come to while they stay.
//   scale: pi / number of links, 0 without links: irradiance per unit of radiance along a link
//   validity: in (0,1]: small where the patch's centre lies inside a solid
//   neighbours: bit x + 3 y + 9 z: it sees the surfel of its direction in cell + (x, y, z) - 1
//   emitters_sampled, emitters_seen: bits of the points on emitters that a ray was sent to, and that it reached
#define LW_LINK_SUMMARY(MEMBER)                                                              \
  MEMBER(vec3, from_sources) /* irradiance from outside the grid and from emitters, W/m^2 */ \
  MEMBER(float, scale)                                                                       \
  MEMBER(float, validity)                                                                    \
  MEMBER(uint, neighbours)                                                                   \
  MEMBER(uint, emitters_sampled)                                                             \
  MEMBER(uint, emitters_seen)
LW_STRUCT(LinkSummary, LW_LINK_SUMMARY)

// What pixels read of a surfel.
#define LW_LIT_SURFEL(MEMBER)                                                \
  MEMBER(vec3, irradiance) /* W/m^2 */                                       \
  MEMBER(float, validity)                                                    \
  MEMBER(uint, position) /* relative to the cell, in 1/1023, 10 bits each */ \
  MEMBER(uint, normal)   /* octahedral, 16 bits each */                      \
  MEMBER(uint, neighbours)                                                   \
  MEMBER(uint, unused)
LW_STRUCT(LitSurfel, LW_LIT_SURFEL)

// Push constants of all kernels of the solver.
#define LW_SURFEL_PARAMS(MEMBER)                                         \
  MEMBER(VoxelGrid, grid)                                                \
  MEMBER(uint, triangle_count)                                           \
  MEMBER(float, emission_scale) /* the scene's largest emission, or 1 */ \
  MEMBER(uint, capacity)        /* surfels that there is room for */     \
  MEMBER(uint, link_count)      /* links a surfel */                     \
  MEMBER(uint, first_link)      /* of those traced now */                \
  MEMBER(uint, traced_links)                                             \
  MEMBER(uint, light_count)                                              \
  MEMBER(uint, used_links)   /* links beyond these are not traced yet */ \
  MEMBER(uvec2, size)        /* of the picture, pixels */                \
  MEMBER(uint, bounced_only) /* 1: pixels get no light straight from emitters and the environment */
LW_PUSH_CONSTANTS(SurfelParams, LW_SURFEL_PARAMS)

#endif
