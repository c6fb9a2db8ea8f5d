// Shadow maps of splats: small orthographic ones, side by side in one image.
#pragma once

#include <cstdint>

#include "techniques/photon_splatting/photons.h"
#include "techniques/photon_splatting/splat_view_types.h"

namespace lightwell {

enum class SplatKernel : std::uint32_t {
  kBox = glsl::kSplatBox,            // the whole square
  kTent = glsl::kSplatTent,          // falls to 0 at the half width
  kGaussian = glsl::kSplatGaussian,  // of half the half width; cut off there
};

// How an atlas is divided.
struct SplatMapLayout {
  std::uint32_t map_side = 4;  // texels
  std::uint32_t maps_per_row = 1;
  std::uint32_t rows = 1;
  std::uint32_t capacity = 1;  // maps
};

// For so many maps of `map_side` texels a side; smaller ones where the device's images, or 256 MiB, hold no more; and
// fewer where not even 4 x 4 texels are left for each.
SplatMapLayout fit_splat_maps(std::uint32_t maps, std::uint32_t map_side, std::uint32_t largest_image);

// Traces a parallel ray for each texel of all splats in use: R32F, see PhotonWorld::shadow_atlas(). `receiver_test`:
// rays begin on the plane of the surface that the photon left, texels hold 0 where they do not meet the surface of the
// splat's center, and the splats get the part of the `kernel` where they do. Where none does, the splat shrinks, and
// its map is its plane.
ImageHandle record_shadow_atlas(FrameGraph& graph, WorldFrame& world, const SplatMapLayout& layout, bool receiver_test,
                                SplatKernel kernel, PhotonSplats& splats);

}  // namespace lightwell
