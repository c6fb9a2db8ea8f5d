// The cache of light on the faces of voxels, as host and kernels see it. light_cache.h tells how it is filled and read.
#ifndef LIGHTWELL_CACHE_TYPES_H
#define LIGHTWELL_CACHE_TYPES_H

#include "passes/voxel_faces/voxel_faces_types.h"
#include "passes/voxel_grid/voxel_levels_types.h"
#include "shaders/shared.h"

// What a face keeps from frame to frame.
//   direct: straight from lights, emitters and the environment. Inject camera: irradiance E, W/m^2; inject light: what
//     of it the surface sends on, radiosity, W/m^2
//   indirect: irradiance E that met a surface before, W/m^2: the mean over its links
#define LW_FACE_LIGHT(MEMBER)                                                                                \
  MEMBER(vec3, direct)                                                                                       \
  MEMBER(float, direct_samples) /* in the mean; inject light: frames */                                      \
  MEMBER(vec3, indirect)                                                                                     \
  MEMBER(float, gathered) /* rays in the mean of near */                                                     \
  MEMBER(vec3, near)      /* of direct, what rays have found of emitters near by */                          \
  MEMBER(uint, vote)      /* the point that it gathers from, as voted; 0: none */                            \
  MEMBER(uint, asked_at)  /* the world's frame in which a ray met the face last */                           \
  MEMBER(uint, links)     /* rays that it has gathered by so far, or could have */                           \
  MEMBER(uint, normal)    /* packed, of the surface at the point */                                          \
  MEMBER(uint, seen)      /* neighbours, a bit each: what was between their points when it was asked last */ \
  MEMBER(ivec3, center)   /* of the levels (VoxelLevels) when its links were looked at last */               \
  MEMBER(uint, page)      /* of its links, counted from 1; 0: none */                                        \
  MEMBER(uint, met)       /* the point that direct light is of; 0: where it gathers from */                  \
  MEMBER(float, variance) /* of the mean over the links, of luminance */                                     \
  MEMBER(uint, seen_at)   /* 1 + the frame in which a pixel read it last; 0: none */                         \
  MEMBER(uint, moves)     /* of all slots, until its links' were found */
LW_STRUCT(FaceLight, LW_FACE_LIGHT)

// What shadow rays leave to gathering rays: `share` of largest_geometry_term() (passes/emitters/emitters.glsl).
LW_CONSTANT(float, kEmitterShare, 2.0f)

// What rays read of a face in one frame besides its indirect light: so many vec4 a face.
LW_CONSTANT(uint, kShownSource, 0) /* direct + near; w: 0 where nothing is known */
LW_CONSTANT(uint, kShownNear, 1)
LW_CONSTANT(uint, kShownWords, 2)

// What pixels and points read of a face. Where a finer level knows its point, this is what that says, and where it is
// young what the coarser one says: as windows move on, nothing jumps.
#define LW_LIT_FACE(MEMBER)                                                                            \
  MEMBER(vec3, irradiance)  /* indirect, W/m^2, of the neighbourhood */                                \
  MEMBER(float, known)      /* [0,1]; 0: nothing */                                                    \
  MEMBER(uint, place)       /* of the face's points, their mean: pack_place() */                       \
  MEMBER(uint, normal)      /* there, packed */                                                        \
  MEMBER(uint, seen)        /* bit x + 3 y + 9 z: the face of its direction in cell + (x, y, z) - 1 */ \
  MEMBER(uint, seen_before) /* as seen, and the steps that these are on their way to be it, of kStepsToSee */
LW_STRUCT(LitFace, LW_LIT_FACE)
LW_CONSTANT(uint, kNeighbours, 27)
LW_CONSTANT(uint, kAllNeighbours, (1u << kNeighbours) - 1)
LW_CONSTANT(uint, kStepsToSee, 16)

// Links (cache_link.glsl): number k of a face is element (page - 1) * link_count + k.
// A face keeps its last params.link_count. Faces take a page when they gather for the first time, as long as there are
// any, and those that nobody has asked for in long give theirs back. Which page a face has shows nowhere.
#define LW_FACE_LINK(MEMBER)                   \
  MEMBER(uint, met)    /* cache_link.glsl */   \
  MEMBER(uint, albedo) /* there, most of it */ \
  MEMBER(uint, slot)   /* as met; where it leads to */
LW_STRUCT(FaceLink, LW_FACE_LINK)
LW_CONSTANT(uint, kLinkEscaped, 0)
LW_CONSTANT(uint, kLinkUnknown, 0x0fffffffu) /* a surface without a face */

// The light that bounces along links, a vec4 an element: irradiance (W/m^2), and 1 where anything is known of it. What
// has met no face has elements of its own, so that nobody asks.
LW_CONSTANT(uint, kFallenEscaped, 0)
LW_CONSTANT(uint, kFallenUnknown, 1)
LW_CONSTANT(uint, kFallenFaces, 2)

// Votes for the points of a face, two words a face. Who reads the light that falls on it, a pixel, and who reads the
// light that it sends on, a ray, see different parts of it: it gathers where pixels see it, if any do, and its direct
// light is that where rays met it. (With one point for both, what lies in the sun before the camera lights the room as
// if all of the face did: up to 4 % more light.)
LW_CONSTANT(uint, kVoteSeen, 0)
LW_CONSTANT(uint, kVoteMet, 1)
LW_CONSTANT(uint, kVoteWords, 2)
// A vote: bounces, a random part, and where in its cell the point lies, in 1/256. The greatest wins: the fewest
// bounces, then at random. Faces that are kMostAsking bounces from the camera ask for no others: else those of a closed
// room that nobody sees would keep each other awake.
LW_CONSTANT(uint, kVoteBounceShift, 30)
LW_CONSTANT(uint, kVoteRandomShift, 24)
LW_CONSTANT(uint, kMostAsking, 3)
// Cells of the level that a ray of this length reads from are no smaller than this part of it: what a ray of many
// stands for is wider.
LW_CONSTANT(float, kFootprint, 1.0f / 16.0f)
// Frames for which a face gathers on after a ray met it.
LW_CONSTANT(uint, kFramesAwake, 16)

// Sums of one frame, a record of shaders/exact_sum.glsl a face: seven words, the count in the fourth. Irradiance is
// held up to 2^13 times the range, in units of 2^-27 of it.
LW_CONSTANT(uint, kInjectWords, 7)
LW_CONSTANT(float, kInjectRange, 128.0f) /* W/m^2 */

// Words of the list of faces that gather: arguments of an indirect dispatch, the number of faces, then their slots.
LW_CONSTANT(uint, kListCount, 3)
LW_CONSTANT(uint, kListHeader, 4)

// Words of the buffer of counts of pages.
LW_CONSTANT(uint, kPagesFree, 0)     // how many of the list of free pages there are
LW_CONSTANT(uint, kPagesShort, 1)    // how many faces wanted one in this round and got none
LW_CONSTANT(uint, kPagesAge, 2)      // frames: faces that were asked for before give theirs back; 0: not known yet
LW_CONSTANT(uint, kPagesGranted, 3)  // faces of groups below this one may take a page
LW_CONSTANT(uint, kPagesWanted, 4)   // of each group, in this round
// Groups of faces that want a page: the coarser levels first, since they answer for the others; in a level at random.
LW_CONSTANT(uint, kPageGroupsOfLevel, 8)
LW_CONSTANT(uint, kPageGroups, 20 * kPageGroupsOfLevel)
LW_CONSTANT(uint, kPageCountWords, kPagesWanted + kPageGroups)
// kPagesAge at most; at least it is kFramesAwake.
LW_CONSTANT(uint, kMostPageAge, 4096)

// Links that make a face as good as its neighbours, and with which it may stand alone where all are young.
LW_CONSTANT(float, kSettledLinks, 16.0f)

// How much faster a face forgets than a mean of all frames, while it is young: what came before a change fades with the
// square of the number of frames. Larger numbers forget faster, and leave more noise.
LW_CONSTANT(float, kFaceBlend, 2.0f)

#ifndef __cplusplus

uint bounces_of_vote(uint vote) {
  return kMostAsking - (vote >> kVoteBounceShift);
}

// The point, in cells from the cell's lower corner.
vec3 place_of_vote(uint vote) {
  return (vec3(vote & 255u, (vote >> 8) & 255u, (vote >> 16) & 255u) + 0.5) / 256.0;
}

// A place in a cell, [0,1]^3, in 1/1023.
uint pack_place(vec3 place) {
  uvec3 steps = uvec3(place * 1023.0 + 0.5);
  return steps.x | steps.y << 10 | steps.z << 20;
}

vec3 unpack_place(uint place) {
  return vec3(place & 1023u, (place >> 10) & 1023u, place >> 20) / 1023.0;
}

// Weight of `count` new samples in a mean of `all`, themselves included.
float face_weight(float count, float all) {
  return kFaceBlend * count / (all + (kFaceBlend - 1.0) * count);
}

#endif

// Who rests, of the faces that were asked for. Young ones have not sent all their rays yet.
LW_CONSTANT(uint, kAllSend, 0)     // nobody
LW_CONSTANT(uint, kAllSample, 1)   // all send shadow rays, and one other that meets new points; the young ones all
LW_CONSTANT(uint, kYoungSend, 2)   // only the young ones send any
LW_CONSTANT(uint, kYoungSolve, 3)  // only the young ones do anything

#define LW_CACHE_PARAMS(MEMBER)                                                                         \
  MEMBER(VoxelLevels, levels)                                                                           \
  MEMBER(uvec2, size)       /* of the picture, pixels; or how many points */                            \
  MEMBER(uvec2, table_size) /* of the environment */                                                    \
  MEMBER(uint, emitter_count)                                                                           \
  MEMBER(uint, light_count)                                                                             \
  MEMBER(uint, frame)          /* of the world */                                                       \
  MEMBER(uint, capacity)       /* faces that there is room for */                                       \
  MEMBER(float, clearance)     /* of pixels' rays, part of their distance */                            \
  MEMBER(float, most_direct)   /* samples (frames) that a face's mean counts for */                     \
  MEMBER(float, most_gathered) /* rays */                                                               \
  MEMBER(uint, count)          /* rays a pixel; light points; the first page; frames; moves of slots */ \
  MEMBER(uint, turn)           /* which pixel of each block is remembered, or asked */                  \
  MEMBER(uint, link_count)     /* a face */                                                             \
  MEMBER(uint, page_count)     /* of so many links each */                                              \
  MEMBER(uint, rays)           /* that a face sends, if any */                                          \
  MEMBER(uint, rest)           /* kAllSend, ... */                                                      \
  MEMBER(uint, asks)           /* kAllSample: links along which a face asks for light */                \
  MEMBER(float, settled)       /* links from which on a face stands alone */                            \
  MEMBER(uint, turns)          /* frames between two of a level in which its faces gather, at most */
LW_PUSH_CONSTANTS(CacheParams, LW_CACHE_PARAMS)

#endif
