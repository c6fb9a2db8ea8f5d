// Parameters of the kernels that make splats and their maps.
#ifndef LIGHTWELL_PHOTON_SPLATTING_PHOTON_PARAMS_H
#define LIGHTWELL_PHOTON_SPLATTING_PHOTON_PARAMS_H

#include "shaders/shared.h"
#include "techniques/photon_splatting/photon_types.h"

// How light points are numbered: rounds of paths, in each all first surfaces, then all second ones, ...
#define LW_PHOTON_PARAMS(MEMBER)                                                        \
  MEMBER(uint, paths)        /* a round */                                              \
  MEMBER(uint, bounces)      /* light points a path */                                  \
  MEMBER(uint, rounds)       /* that the points hold */                                 \
  MEMBER(uint, all_rounds)   /* of the frame, among which sources' light is shared */   \
  MEMBER(uint, first_path)   /* of the sequence */                                      \
  MEMBER(uint, capacity)     /* splats */                                               \
  MEMBER(uint, map_side)     /* texels */                                               \
  MEMBER(uint, maps_per_row) /* of the atlas */                                         \
  MEMBER(float, half_width)  /* m, of one photon where all are alike; 0: by its area */ \
  MEMBER(float, photons)     /* that a kernel holds about */                            \
  MEMBER(float, least_half)  /* m */                                                    \
  MEMBER(float, most_half)   /* m */                                                    \
  MEMBER(float, step_back)   /* m; 0: as far as the plane of the surface is in the box */
LW_PUSH_CONSTANTS(PhotonParams, LW_PHOTON_PARAMS)

#endif
