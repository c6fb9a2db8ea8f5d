// Corners for acceleration structures: parameters shared with ray_query_corners.comp.
#ifndef LIGHTWELL_RAY_QUERY_CORNERS_PARAMS_H
#define LIGHTWELL_RAY_QUERY_CORNERS_PARAMS_H

#include "shaders/shared.h"

// Triangles [first, first + count) of the scene without the `gap_count` from `gap_first` on.
#define LW_RAY_QUERY_CORNERS_PARAMS(MEMBER) \
  MEMBER(uint, first)                       \
  MEMBER(uint, count)                       \
  MEMBER(uint, gap_first)                   \
  MEMBER(uint, gap_count)
LW_PUSH_CONSTANTS(RayQueryCornersParams, LW_RAY_QUERY_CORNERS_PARAMS)

#endif
