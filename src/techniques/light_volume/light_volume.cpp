// Light volume: diffuse global illumination from a grid of cells. Presets: the published algorithm and, for comparison,
// light propagation volumes.
#include "lightwell/error.h"
#include "techniques/light_volume/best.h"
#include "techniques/light_volume/paper_solver.h"

namespace lightwell {
namespace {

constexpr std::string_view kPresets[] = {"best", "paper", "paper-lpv"};

std::unique_ptr<Technique> create_light_volume(std::string_view preset) {
  if (preset == "best") return std::make_unique<LightVolumeBest>();
  if (preset == "paper") return std::make_unique<LightVolumePaper>(PaperVariant::kMavridis);
  LW_ASSERT(preset == "paper-lpv", std::string(preset));
  return std::make_unique<LightVolumePaper>(PaperVariant::kKaplanyan);
}

}  // namespace

extern const TechniqueInfo kTechnique_light_volume;
const TechniqueInfo kTechnique_light_volume{
    "light-volume",
    "Light on a grid of cells, propagated in spherical harmonics (Mavridis et al. 2010).",
    kPresets,
    create_light_volume,
};

}  // namespace lightwell
