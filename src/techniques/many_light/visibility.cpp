#include "techniques/many_light/visibility.h"

namespace lightwell {

ComputePass& gather_compute(FrameGraph& graph, std::string_view name, const GatherKernels& kernels, WorldFrame& world,
                            const ManyLightWorld& part) {
  switch (part.options().visibility) {
    case Visibility::kTriangles:
      return trace_compute(graph, name, kernels.rays, world);
    case Visibility::kVoxels:
      return graph.compute(name, kernels.voxels).bind(part.svo().set);
    case Visibility::kSvoRestart:
      return graph.compute(name, kernels.svo_restart).bind(part.svo().set);
    case Visibility::kNone:
      break;
  }
  return graph.compute(name, kernels.unshadowed);
}

}  // namespace lightwell
