// Paths of light from its sources over the scene's surfaces: where they meet a surface they leave a light point, which
// a caller gathers from as a virtual light or stores as a photon. Traced anew every frame, on the device.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "graph/frame_graph.h"
#include "passes/focus/focus_balls.h"
#include "passes/lights/light_kinds.h"
#include "passes/rsm/rsm.h"
#include "passes/view/view_frame.h"
#include "passes/world/world.h"

namespace lightwell {

enum class PathSequence : std::uint8_t {
  kHalton,  // a prime base a dimension; of no use beyond five surfaces, where bases exceed 50
  kSobol  // Owen-scrambled; start and first three surfaces stratified together, the others two dimensions each. Of 1024
          // paths the second surface's flux has half to three quarters of the Halton sequence's error
};

struct LightPathSettings {
  std::uint32_t paths = 1024;  // [16, 65536]; time in proportion
  std::uint32_t bounces = 3;   // surfaces of a path, [1, 8]; each costs a ray a path that has not ended
  LightKinds kinds = LightKinds::kLights | LightKinds::kEmitters | LightKinds::kEnvironment;  // sources, of these three
  std::uint32_t rsm_lights = 16;  // lights start from reflective shadow maps where there are at most so many; 0: never
  PathSequence sequence = PathSequence::kSobol;
  // What suns and skies aim their rays at, all about the first one's centre: an even part of them goes to each ball, to
  // one between each and the next, and over the whole scene. That changes noise alone. Default: the world's.
  std::optional<std::vector<FocusBall>> aims;
};

// Where paths should start, and where they did: passes/light_paths/light_path_guide.h. For paths that all start as
// rays.
struct LightPathGuide {
  BufferHandle table;   // float, glsl::kGuideFloats for each of world.lights.count + 2 sources
  BufferHandle counts;  // uvec2 a stratum: x is raised by the paths that start there
};

// Whether paths of lights start from maps, so that the caller should record them.
bool starts_from_maps(const WorldFrame& world, const LightPathSettings& settings);

// Declares this frame's paths. Gives a buffer of glsl::LightPoint, paths * bounces: element b * paths + i is surface
// number b + 1 of path i; its flux is 0 where the path has ended before. The flux of all elements of one b estimates,
// in W, all light that surfaces reflect after it met b + 1 of them; what surfaces emit is not in it.
//
// Paths choose a source in proportion to power, so that every contiguous sixteenth of them is a fair, coarser sample of
// all sources; to use one by itself, scale its flux by 16. `round`: the paths are numbers [round * paths, (round + 1) *
// paths) of one sequence: the same round in the same scene gives the same bytes, and rounds that follow each other
// complement each other.
//
// `maps`: of this frame, or empty; lights without a map start as rays.
BufferHandle record_light_paths(FrameGraph& graph, WorldFrame& world, const ReflectiveShadowMaps::Frame& maps,
                                const LightPathSettings& settings, std::uint32_t round);

struct SizedLightPaths {
  BufferHandle points;
  BufferHandle areas;   // float a point, m^2: of the surface there, what one path stands for, about
  BufferHandle strata;  // with a guide, uint a path: stratum where it started, or glsl::kNoStratum
};

// The same, with an estimate of how densely the points of each bounce lie: 1 over the points a m^2. With a `guide` more
// paths start where it says, with less flux: sums of flux stay what they are in the mean.
SizedLightPaths record_sized_light_paths(FrameGraph& graph, WorldFrame& world, const ReflectiveShadowMaps::Frame& maps,
                                         const LightPathSettings& settings, std::uint32_t round,
                                         LightPathGuide* guide = nullptr);

enum class LightPointColor : std::uint8_t { kFlux, kBounce };

// A picture (RGBA16F, the view's size) of the light points that the camera sees: discs over a dim picture of the scene,
// in the colour of their flux, or 1 white, 2 yellow, 3 orange, 4 red, ... by the bounce.
ImageHandle record_light_point_view(FrameGraph& graph, const ViewFrame& view, BufferHandle points, std::uint32_t count,
                                    LightPointColor color = LightPointColor::kFlux);

}  // namespace lightwell
