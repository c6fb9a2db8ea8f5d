// Reflective shadow maps (Dachsbacher and Stamminger 2005) of all lights, in one atlas: what each light sees, and the
// flux that it reflects there. Light paths start from them, and one-bounce techniques gather from them.
#pragma once

#include <cstdint>
#include <vector>

#include "graph/frame_graph.h"
#include "passes/world/world.h"
#include "shaders/shadow_view.h"

namespace lightwell {

// A point light has six tiles, a spot or directional light one, spots too wide for one view six. Tiles are squares of a
// power of two of texels and meet without overlap; a directional light's view holds the whole scene. So the texels'
// flux sums to all that the lights' first surfaces reflect.
class ReflectiveShadowMaps {
 public:
  struct Settings {
    std::uint32_t tile_side = 256;  // texels a side and view, [32, 1024], rounded down to a power of two; time and
                                    // memory (60 bytes a texel) grow with its square
  };

  // Empty where no light has a map.
  struct Frame {
    ImageHandle position;  // RGBA32F: world position, m; w: 1, or 0 where the light meets nothing
    ImageHandle normal;    // RGBA32F: unit normal of the triangle, on the side that the light hits
    ImageHandle flux;      // RGBA32F: W that the texel reflects; w: survival_of() its albedo (shaders/light_point.glsl)
    ImageHandle luminances;  // R32F: of the flux; each mip's texel is the sum of the four below, down to one a tile
    BufferHandle views;      // glsl::ShadowView a light; kShadowNone: no map
    BufferHandle powers;     // float a light: luminance of the flux that its maps reflect, W; -1: no map
    std::uint32_t top_level = 0;    // of the mips: where a tile is one texel
    std::uint32_t light_count = 0;  // that have maps
    explicit operator bool() const { return static_cast<bool>(flux); }
  };

  // Draws the maps of those lights that have changed since theirs were drawn, or of all lights where a surface has;
  // keeps the others as histories. Where the tiles of all lights are more than 2048 x 2048 texels, all shrink alike,
  // and lights for which there is no room at 32 texels a side have no map.
  Frame record(FrameGraph& graph, const WorldFrame& world, const Settings& settings);

 private:
  struct Drawn {
    glsl::ShadowView view;
    std::uint64_t revision = 0;  // of the light
  };
  std::vector<std::uint32_t> list_changed(const std::vector<Drawn>& now) const;

  std::vector<Drawn> drawn_;
  SceneRevisions drawn_revisions_;  // of the scene that they show
};

// The scene's bounds; where a vertex is not finite, those of the parts that are.
Bounds finite_bounds(const WorldFrame& world);

}  // namespace lightwell
