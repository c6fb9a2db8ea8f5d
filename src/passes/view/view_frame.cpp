#include "passes/view/view_frame.h"

namespace lightwell {

ViewFrame::ViewFrame(FrameGraph& graph, WorldFrame& world_frame, glm::uvec2 size, const WorldCamera& world_camera,
                     const PixelSample& sample, const glsl::GpuCamera* previous)
    : world(world_frame), graph_(graph) {
  const EyeCamera eye = make_perspective(world_camera, world.snapshot.bounds);
  camera = make_gpu_camera(eye.camera, size, sample, previous);
  eye_behind = eye.behind;
  if (previous != nullptr) previous_camera = *previous;
  camera_buffer = graph.upload<glsl::GpuCamera>("camera", {&camera, 1});
  gbuffer = record_gbuffer(graph, world.scene, camera_buffer, world.environment, size.x, size.y,
                           world.gpu_environment().constant_radiance());
}

const Reprojection& ViewFrame::reprojection() {
  if (!reprojection_) reprojection_ = record_reprojection(graph_, gbuffer, camera);
  return *reprojection_;
}

}  // namespace lightwell
