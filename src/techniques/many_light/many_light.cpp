// Many light: thousands of virtual point lights, made anew every frame.
#include "lightwell/error.h"
#include "techniques/many_light/best.h"
#include "techniques/many_light/paper.h"

namespace lightwell {
namespace {

constexpr std::string_view kPresets[] = {"best", "paper"};

std::unique_ptr<Technique> create_many_light(std::string_view preset) {
  if (preset == "best") return std::make_unique<ManyLightBest>();
  LW_ASSERT(preset == "paper", std::string(preset));
  return std::make_unique<ManyLightPaper>();
}

}  // namespace

extern const TechniqueInfo kTechnique_many_light;
const TechniqueInfo kTechnique_many_light{
    "many-light",
    "Thousands of virtual point lights, shadowed by rays (Sun and Agu 2015).",
    kPresets,
    create_many_light,
};

}  // namespace lightwell
