// The picture of light points: parameters shared with its kernels.
#ifndef LIGHTWELL_LIGHT_POINT_VIEW_PARAMS_H
#define LIGHTWELL_LIGHT_POINT_VIEW_PARAMS_H

#include "shaders/shared.h"

#define LW_LIGHT_POINT_VIEW_PARAMS(MEMBER)        \
  MEMBER(float, radius)   /* of a disc, pixels */ \
  MEMBER(uint, by_bounce) /* the colour; else by the flux */
LW_PUSH_CONSTANTS(LightPointViewParams, LW_LIGHT_POINT_VIEW_PARAMS)

#endif
