// Traces a list of rays: parameters and elements shared with trace_rays.comp.
#ifndef LIGHTWELL_TRACE_RAYS_TYPES_H
#define LIGHTWELL_TRACE_RAYS_TYPES_H

#include "shaders/shared.h"

#define LW_RAY_PARAMS(MEMBER) MEMBER(uint, ray_count) MEMBER(uint, any_hit)
LW_PUSH_CONSTANTS(RayParams, LW_RAY_PARAMS)

#define LW_LISTED_RAY(MEMBER) MEMBER(vec3, origin) MEMBER(float, t_min) MEMBER(vec3, direction) MEMBER(float, t_max)
LW_STRUCT(ListedRay, LW_LISTED_RAY)

// triangle: 0xffffffff: nothing met; with any_hit set: 0 if blocked.
#define LW_LISTED_HIT(MEMBER) MEMBER(float, t) MEMBER(uint, triangle) MEMBER(vec2, barycentrics)
LW_STRUCT(ListedHit, LW_LISTED_HIT)

#endif
