// Push constants of the hierarchy's kernels.
#ifndef LIGHTWELL_BVH_PARAMS_H
#define LIGHTWELL_BVH_PARAMS_H

#include "passes/trace/bvh_types.h"

LW_PUSH_CONSTANTS(BvhParams, LW_BVH_PARAMS)

#endif
