#include "passes/reprojection/reprojection.h"

#include "kernels/passes/reprojection/reproject.comp.h"
#include "passes/camera/camera.h"
#include "passes/reprojection/reproject_params.h"

namespace lightwell {

Reprojection record_reprojection(FrameGraph& graph, const GBuffer& gbuffer, const glsl::GpuCamera& camera) {
  const auto desc = [&](VkFormat format) {
    return ImageDesc{.width = gbuffer.width, .height = gbuffer.height, .format = format};
  };
  ImagePair surface = graph.history_pair("surface", desc(VK_FORMAT_R32G32B32A32_UINT));
  Reprojection reprojection{gbuffer.motion, graph.create_image("reprojection", desc(VK_FORMAT_R32_UINT))};
  graph.compute("reproject", kernels::reprojection_reproject_comp)
      .read("position", gbuffer.position)
      .read("normal", gbuffer.normal)
      .read("emission", gbuffer.emission)
      .read("face", gbuffer.face)
      .read("motion", gbuffer.motion)
      .read("last_surface", surface.previous)
      .write("reprojection", reprojection.taps)
      .write("surface", surface.current)
      .push(glsl::ReprojectParams{.size = {gbuffer.width, gbuffer.height},
                                  .has_history = surface.valid ? 1u : 0u,
                                  .pixel_tangent = pixel_tangent(camera),
                                  .camera_position = camera.position})
      .dispatch_threads(gbuffer.width, gbuffer.height);
  return reprojection;
}

ComputePass& read_reprojection(ComputePass& pass, const Reprojection& reprojection) {
  return pass.read("motion", reprojection.motion).read("reprojection", reprojection.taps);
}

}  // namespace lightwell
