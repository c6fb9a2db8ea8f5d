#include "passes/combine/combine.h"

#include <string>
#include <string_view>

#include "kernels/passes/combine/combine.comp.h"
#include "kernels/passes/combine/film.comp.h"
#include "passes/combine/combine_params.h"

namespace lightwell {
namespace {

// Binds what both kernels read. A part that is not there needs some image in its place.
void read_parts(ComputePass& pass, const GBuffer& gbuffer, const LightParts& parts) {
  pass.read("albedo", gbuffer.albedo)
      .read("emission", gbuffer.emission)
      .read("direct", parts.direct ? parts.direct : gbuffer.albedo)
      .read("indirect", parts.indirect ? parts.indirect : gbuffer.albedo)
      .read("specular", parts.specular ? parts.specular : gbuffer.albedo);
}

glsl::CombineParams make_params(const GBuffer& gbuffer, const LightParts& parts, bool first_sample) {
  return {.size = {gbuffer.width, gbuffer.height},
          .has_direct = parts.direct ? 1u : 0u,
          .has_indirect = parts.indirect ? 1u : 0u,
          .has_specular = parts.specular ? 1u : 0u,
          .first_sample = first_sample ? 1u : 0u};
}

}  // namespace

ImageHandle record_combine(FrameGraph& graph, const GBuffer& gbuffer, const LightParts& parts) {
  ImageHandle radiance = graph.create_image(
      "radiance", {.width = gbuffer.width, .height = gbuffer.height, .format = VK_FORMAT_R32G32B32A32_SFLOAT});
  ComputePass& pass = graph.compute("combine", kernels::combine_combine_comp);
  read_parts(pass, gbuffer, parts);
  pass.write("radiance", radiance)
      .push(make_params(gbuffer, parts, false))
      .dispatch_threads(gbuffer.width, gbuffer.height);
  return radiance;
}

Film record_film(FrameGraph& graph, const GBuffer& gbuffer, const LightParts& parts, bool first_sample) {
  static constexpr std::array<std::string_view, 5> kNames{"film_direct", "film_indirect", "film_emission",
                                                          "film_albedo", "film_normal_depth"};
  Film film;
  ComputePass& pass = graph.compute("film", kernels::combine_film_comp);
  read_parts(pass, gbuffer, parts);
  pass.read("position", gbuffer.position).read("normal", gbuffer.normal);
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    bool fresh = false;
    film.images[i] = graph.history_image(
        kNames[i], {.width = gbuffer.width, .height = gbuffer.height, .format = VK_FORMAT_R32G32B32A32_SFLOAT}, fresh);
    first_sample = first_sample || fresh;
    pass.write(kNames[i], film.images[i]);
  }
  pass.push(make_params(gbuffer, parts, first_sample)).dispatch_threads(gbuffer.width, gbuffer.height);
  return film;
}

}  // namespace lightwell
