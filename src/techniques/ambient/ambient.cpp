// The smallest technique: constant ambient light. docs/adding_a_technique.md walks through this file.
#include "techniques/ambient/ambient.h"

#include "kernels/techniques/ambient/ambient.comp.h"
#include "techniques/technique.h"

namespace lightwell {

namespace {

class Ambient : public Technique {
 public:
  void describe(OptionVisitor& visitor) override {
    visitor.visit({"irradiance", "irradiance on every surface", "W/m^2", ""}, irradiance_, 0.0f, 1e6f);
  }

  GiResult record_view(FrameGraph& graph, TechniqueWorld*, ViewFrame& view) override {
    const GBuffer& gbuffer = view.gbuffer;
    GiResult result;
    result.irradiance =
        graph.create_image("ambient irradiance",
                           {.width = gbuffer.width, .height = gbuffer.height, .format = VK_FORMAT_R32G32B32A32_SFLOAT});
    graph.compute("ambient", kernels::ambient_ambient_comp)
        .read("position", gbuffer.position)
        .write("irradiance", result.irradiance)
        .push(glsl::AmbientParams{{gbuffer.width, gbuffer.height}, irradiance_})
        .dispatch_threads(gbuffer.width, gbuffer.height);
    return result;
  }

 private:
  float irradiance_ = 0.5f;
};

constexpr std::string_view kPresets[] = {"best"};

}  // namespace

extern const TechniqueInfo kTechnique_ambient;
const TechniqueInfo kTechnique_ambient{
    "ambient", "the same light everywhere: a floor to compare with, and the template for new techniques", kPresets,
    [](std::string_view) -> std::unique_ptr<Technique> { return std::make_unique<Ambient>(); }};

}  // namespace lightwell
