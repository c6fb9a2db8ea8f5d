#include "techniques/photon_splatting/paper_passes.h"

#include "kernels/techniques/photon_splatting/paper_blur.comp.h"
#include "kernels/techniques/photon_splatting/paper_normalise.comp.h"
#include "techniques/photon_splatting/paper_types.h"

namespace lightwell {

ImageHandle record_paper_normalise(FrameGraph& graph, const GBuffer& gbuffer, ImageHandle accumulated, float exposure,
                                   float ambient) {
  const glm::uvec2 size(gbuffer.width, gbuffer.height);
  ImageHandle normalised = graph.create_image(
      "normalised splats", {.width = size.x, .height = size.y, .format = VK_FORMAT_R32G32B32A32_SFLOAT});
  graph.compute("splats: normalise", kernels::photon_splatting_paper_normalise_comp)
      .read("accumulated", accumulated)
      .read("position", gbuffer.position)
      .write("normalised", normalised)
      .push(glsl::PaperNormaliseParams{size, exposure, ambient})
      .dispatch_threads(size.x, size.y);
  return normalised;
}

ImageHandle record_paper_blur(FrameGraph& graph, ImageHandle source, std::uint32_t radius) {
  if (radius == 0) return source;
  const ImageDesc desc = graph.desc(source);
  for (const glm::ivec2 step : {glm::ivec2(1, 0), glm::ivec2(0, 1)}) {
    ImageHandle target = graph.create_image("blurred splats", desc);
    graph.compute("splats: blur", kernels::photon_splatting_paper_blur_comp)
        .read("source", source)
        .write("target", target)
        .push(glsl::PaperBlurParams{{desc.width, desc.height}, step, static_cast<int>(radius)})
        .dispatch_threads(desc.width, desc.height);
    source = target;
  }
  return source;
}

}  // namespace lightwell
