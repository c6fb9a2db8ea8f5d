// Push constants of the kernels of this folder.
#ifndef LIGHTWELL_LIGHT_CLUSTERS_PARAMS_H
#define LIGHTWELL_LIGHT_CLUSTERS_PARAMS_H

#include "passes/light_clusters/light_clusters_types.h"

LW_PUSH_CONSTANTS(ClusterParams, LW_CLUSTER_PARAMS)

#endif
