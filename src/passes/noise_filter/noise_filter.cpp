#include "passes/noise_filter/noise_filter.h"

#include <string>

#include "kernels/passes/noise_filter/noise_filter.comp.h"
#include "kernels/passes/noise_filter/temporal_mean.comp.h"
#include "kernels/passes/noise_filter/variance.comp.h"
#include "passes/camera/camera.h"
#include "passes/noise_filter/noise_filter_params.h"
#include "passes/noise_filter/temporal_mean_params.h"

namespace lightwell {

TemporalMean record_temporal_mean(FrameGraph& graph, std::string_view name, ImageHandle signal,
                                  const Reprojection& reprojection, const TemporalBlend& blend) {
  const std::string mean_name = std::string(name) + " mean";
  ImageDesc desc{.width = graph.desc(signal).width, .height = graph.desc(signal).height};
  desc.format = VK_FORMAT_R32G32B32A32_SFLOAT;
  ImagePair mean = graph.history_pair(mean_name, desc);
  desc.format = VK_FORMAT_R32_SFLOAT;
  ImagePair mean_square = graph.history_pair(mean_name + " square", desc);
  const bool has_history = mean.valid && mean_square.valid;
  read_reprojection(graph.compute(mean_name, kernels::noise_filter_temporal_mean_comp), reprojection)
      .read("signal", signal)
      .read("last_mean", mean.previous)
      .read("last_mean_square", mean_square.previous)
      .read("limits", blend.limits ? blend.limits : signal)
      .write("mean", mean.current)
      .write("mean_square", mean_square.current)
      .constant("kWeighted", blend.weighted ? 1 : 0)
      .push(glsl::TemporalMeanParams{.size = {desc.width, desc.height},
                                     .has_history = has_history ? 1u : 0u,
                                     .most_frames = blend.most_frames,
                                     .blend_factor = blend.blend_factor,
                                     .limit_block = blend.limits ? blend.limit_block : 0})
      .dispatch_threads(desc.width, desc.height);
  return {mean.current, mean_square.current, has_history};
}

ImageHandle record_noise_filter(FrameGraph& graph, std::string_view name, const TemporalMean& signal,
                                const GBuffer& gbuffer, const glsl::GpuCamera& camera,
                                const NoiseFilterSettings& settings) {
  const ImageDesc desc{.width = gbuffer.width, .height = gbuffer.height, .format = VK_FORMAT_R32G32B32A32_SFLOAT};
  glsl::NoiseFilterParams params{{gbuffer.width, gbuffer.height}, pixel_tangent(camera), 0, 0};
  ImageHandle filtered = graph.create_image(std::string(name) + " estimate", desc);
  graph.compute(std::string(name) + " variance", kernels::noise_filter_variance_comp)
      .read("position", gbuffer.position)
      .read("normal", gbuffer.normal)
      .read("mean", signal.mean)
      .read("mean_square", signal.mean_square)
      .write("estimate", filtered)
      .constant("kIndependent", settings.independent ? 1 : 0)
      .push(params)
      .dispatch_threads(gbuffer.width, gbuffer.height);
  for (const int step : settings.steps) {
    params.step = step;
    params.diagonal = 1 - params.diagonal;
    ImageHandle target = graph.create_image(std::string(name) + " filtered", desc);
    graph.compute(std::string(name) + " filter", kernels::noise_filter_noise_filter_comp)
        .read("position", gbuffer.position)
        .read("normal", gbuffer.normal)
        .read("source", filtered)
        .write("target", target)
        .constant("kKeepsLight", settings.keeps_light ? 1 : 0)
        .push(params)
        .dispatch_threads(gbuffer.width, gbuffer.height);
    filtered = target;
  }
  return filtered;
}

}  // namespace lightwell
