// Push constants of light_tiles.comp and light_choice.comp.
#ifndef LIGHTWELL_LIGHT_SAMPLER_PARAMS_H
#define LIGHTWELL_LIGHT_SAMPLER_PARAMS_H

#include "passes/light_clusters/light_clusters_types.h"

#ifdef __cplusplus
LW_PUSH_CONSTANTS(LightTileParams, LW_TILE_PARAMS)
LW_PUSH_CONSTANTS(LightChoiceParams, LW_CHOICE_PARAMS)
#endif

#endif
