// Photon splatting: photons bundled on rays, each with a small shadow map of what is at its end.
#include "lightwell/error.h"
#include "techniques/photon_splatting/best.h"
#include "techniques/photon_splatting/paper.h"

namespace lightwell {
namespace {

constexpr std::string_view kPresets[] = {"best", "paper"};

std::unique_ptr<Technique> create_photon_splatting(std::string_view preset) {
  if (preset == "best") return std::make_unique<PhotonSplattingBest>();
  LW_ASSERT(preset == "paper", std::string(preset));
  return std::make_unique<PhotonSplattingPaper>();
}

}  // namespace

extern const TechniqueInfo kTechnique_photon_splatting;
const TechniqueInfo kTechnique_photon_splatting{
    "photon-splatting",
    "Photons on their last ray, bundled, with a shadow map at its end, splatted onto what the camera sees.",
    kPresets,
    create_photon_splatting,
};

}  // namespace lightwell
