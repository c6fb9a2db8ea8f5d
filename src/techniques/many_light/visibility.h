// The kernels that gather light, in one form for each way to shadow it.
#pragma once

#include <string_view>

#include "passes/world/world.h"
#include "techniques/many_light/world_part.h"

namespace lightwell {

// One kernel in its four forms.
struct GatherKernels {
  const TraceKernel& rays;
  const KernelCode& voxels;
  const KernelCode& svo_restart;
  const KernelCode& unshadowed;
};

// Declares the form that the world part's visibility wants, with what it takes to answer its rays.
ComputePass& gather_compute(FrameGraph& graph, std::string_view name, const GatherKernels& kernels, WorldFrame& world,
                            const ManyLightWorld& part);

}  // namespace lightwell
