// Push constants of the kernels that sort and add up.
#ifndef LIGHTWELL_SORT_PARAMS_H
#define LIGHTWELL_SORT_PARAMS_H

#include "passes/sort/sort_types.h"

#define LW_SORT_PARAMS(MEMBER)                \
  MEMBER(uint, count) /* keys, or elements */ \
  MEMBER(uint, shift) /* of the digit sorted by */
LW_PUSH_CONSTANTS(SortParams, LW_SORT_PARAMS)

#endif
