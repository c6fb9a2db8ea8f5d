// Runs light paths of a scene frame by frame, the way a technique does. For tests only.
#pragma once

#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <glm/ext/vector_double3.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>

#include "gpu/submit.h"
#include "graph/executor.h"
#include "lightwell/scene.h"
#include "passes/light_paths/light_path_guide.h"
#include "passes/light_paths/light_paths.h"
#include "passes/rsm/rsm.h"
#include "shaders/light_point.h"

namespace lightwell {

using LightPoints = std::vector<glsl::LightPoint>;

class LightPathFrames {
 public:
  LightPathFrames(Device& device, Scene scene, const SceneSnapshot& snapshot)
      : world(snapshot),
        scene_(std::move(scene)),
        executor_(device),
        submitter_(device),
        world_(device, scene_, world, {.tracing = Tracing::kBvh}) {}
  LightPathFrames(Device& device, const Scene& scene) : LightPathFrames(device, scene, take_snapshot(scene)) {}
  // The scene at rest with other lights.
  LightPathFrames(Device& device, const Scene& scene, const std::vector<WorldLight>& lights,
                  const LightPathSettings& path_settings = {})
      : LightPathFrames(device, scene, with_lights(take_snapshot(scene), lights)) {
    settings = path_settings;
  }

  // The light points of the next frame.
  LightPoints next(std::uint32_t round = 0) {
    FrameGraph graph(executor_.context());
    WorldFrame frame(graph, world_, world, 0.0);
    const ReadbackTicket ticket =
        graph.read_back(record_light_paths(graph, frame, record_maps(graph, frame), settings, round));
    run(graph);
    return fetch<glsl::LightPoint>(ticket);
  }

  // The areas (m^2) for which the next frame's points stand.
  std::vector<float> next_areas(std::uint32_t round = 0) {
    FrameGraph graph(executor_.context());
    WorldFrame frame(graph, world_, world, 0.0);
    const ReadbackTicket ticket =
        graph.read_back(record_sized_light_paths(graph, frame, record_maps(graph, frame), settings, round).areas);
    run(graph);
    return fetch<float>(ticket);
  }

  struct Guided {
    LightPoints points;
    std::vector<float> areas;
    std::vector<std::uint32_t> strata;  // of paths
    std::vector<glm::uvec2> counts;     // of strata
  };

  // The next frame's paths by a guide.
  Guided next_guided(const std::vector<float>& table, std::uint32_t round = 0) {
    FrameGraph graph(executor_.context());
    WorldFrame frame(graph, world_, world, 0.0);
    const std::uint32_t strata = (frame.lights.count + 2) * glsl::kGuideStrata;
    LightPathGuide guide{graph.upload<float>("guide", table),
                         graph.create_buffer("stratum counts", strata, sizeof(glm::uvec2))};
    graph.fill("clear counts", guide.counts, 0);
    const SizedLightPaths paths =
        record_sized_light_paths(graph, frame, record_maps(graph, frame), settings, round, &guide);
    const ReadbackTicket tickets[]{graph.read_back(paths.points), graph.read_back(paths.areas),
                                   graph.read_back(paths.strata), graph.read_back(guide.counts)};
    run(graph);
    return {fetch<glsl::LightPoint>(tickets[0]), fetch<float>(tickets[1]), fetch<std::uint32_t>(tickets[2]),
            fetch<glm::uvec2>(tickets[3])};
  }

  struct Maps {
    std::vector<glsl::ShadowView> views;
    std::vector<float> powers;
    std::vector<glm::vec4> position, normal, flux;
    std::vector<std::vector<float>> luminances;  // by mip
    std::uint32_t width = 0;                     // texels of the atlas
    std::uint32_t height = 0;
    std::vector<std::string> passes;  // that drew them
  };

  // The maps of the next frame.
  Maps next_maps() {
    FrameGraph graph(executor_.context());
    WorldFrame frame(graph, world_, world, 0.0);
    const ReflectiveShadowMaps::Frame recorded = record_maps(graph, frame);
    if (!recorded) return {};
    const ReadbackTicket tickets[]{graph.read_back(recorded.views), graph.read_back(recorded.powers),
                                   graph.read_back(recorded.position), graph.read_back(recorded.normal),
                                   graph.read_back(recorded.flux)};
    std::vector<ReadbackTicket> mips;
    for (std::uint32_t mip = 0; mip <= recorded.top_level; ++mip)
      mips.push_back(graph.read_back(recorded.luminances, mip));
    Maps maps{.width = graph.desc(recorded.flux).width, .height = graph.desc(recorded.flux).height};
    for (const Pass& pass : graph.passes())
      if (base_of(pass).name.starts_with("rsm: ")) maps.passes.push_back(base_of(pass).name);
    run(graph);
    maps.views = fetch<glsl::ShadowView>(tickets[0]);
    maps.powers = fetch<float>(tickets[1]);
    maps.position = fetch<glm::vec4>(tickets[2]);
    maps.normal = fetch<glm::vec4>(tickets[3]);
    maps.flux = fetch<glm::vec4>(tickets[4]);
    for (const ReadbackTicket& mip : mips) maps.luminances.push_back(fetch<float>(mip));
    return maps;
  }

  // RGB of record_light_point_view() of the next frame.
  Image picture(std::uint32_t side, const WorldCamera& camera, LightPointColor color) {
    FrameGraph graph(executor_.context());
    WorldFrame frame(graph, world_, world, 0.0);
    const ViewFrame view(graph, frame, {side, side}, camera, {}, nullptr);
    const BufferHandle points = record_light_paths(graph, frame, record_maps(graph, frame), settings, 0);
    const ReadbackTicket ticket =
        graph.read_back(record_light_point_view(graph, view, points, settings.paths * settings.bounces, color));
    run(graph);
    const auto halves = fetch<std::uint16_t>(ticket);
    Image image(static_cast<int>(side), static_cast<int>(side));
    for (std::size_t i = 0; i < halves.size() / 4; ++i)
      for (std::size_t c = 0; c < 3; ++c) image.pixels[3 * i + c] = glm::unpackHalf1x16(halves[4 * i + c]);
    return image;
  }

  SceneSnapshot world;  // of the next frame
  LightPathSettings settings;
  ReflectiveShadowMaps::Settings map_settings;
  std::map<std::string, double> times_ms;  // by pass, of the last frame

 private:
  static SceneSnapshot with_lights(SceneSnapshot snapshot, const std::vector<WorldLight>& lights) {
    snapshot.lights = lights;
    return snapshot;
  }

  ReflectiveShadowMaps::Frame record_maps(FrameGraph& graph, const WorldFrame& frame) {
    if (!starts_from_maps(frame, settings)) return {};
    return maps_.record(graph, frame, map_settings);
  }

  void run(FrameGraph& graph) {
    submitter_.run([&](VkCommandBuffer commands) { frame_ = executor_.record(graph, commands, frame_); });
    times_ms.clear();
    for (const PassTime& pass : executor_.pass_times(frame_)) times_ms[pass.name] += pass.time_ms;
  }

  template <class T>
  std::vector<T> fetch(const ReadbackTicket& ticket) {
    const std::vector<std::byte> bytes = executor_.fetch(frame_, ticket);
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    return values;
  }

  Scene scene_;
  GraphExecutor executor_;
  Submitter submitter_;
  World world_;
  ReflectiveShadowMaps maps_;
  std::uint64_t frame_ = 0;
};

// Flux (W) of the light points of elements [first, end).
inline glm::dvec3 sum_flux(const LightPoints& points, std::size_t first, std::size_t end) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = first; i < end; ++i) sum += glm::dvec3(points[i].flux);
  return sum;
}

// Of surface number `bounce` of all paths.
inline glm::dvec3 sum_bounce(const LightPoints& points, std::size_t paths, std::size_t bounce) {
  return sum_flux(points, (bounce - 1) * paths, bounce * paths);
}

// ---- scenes ----

inline Material make_material(const glm::vec3& albedo, const glm::vec3& emission = glm::vec3(0.0f)) {
  Material material;
  material.base_color = {albedo, 1.0f};
  material.emission = emission;
  return material;
}

inline void add_primitive(Scene& scene, Primitive primitive, const Material& material) {
  primitive.material = static_cast<int>(scene.materials.size());
  scene.materials.push_back(material);
  Node node;
  node.mesh = static_cast<int>(scene.meshes.size());
  scene.meshes.emplace_back().primitives.push_back(std::move(primitive));
  scene.nodes.push_back(node);
}

// Parallelogram corner, + a, + a + b, + b; its front is the side that a x b points to.
inline void add_quad(Scene& scene, const glm::vec3& corner, const glm::vec3& a, const glm::vec3& b,
                     const Material& material) {
  Primitive quad;
  quad.positions = {corner, corner + a, corner + a + b, corner + b};
  quad.normals.assign(4, glm::normalize(glm::cross(a, b)));
  quad.texcoords[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  quad.indices = {0, 1, 2, 0, 2, 3};
  add_primitive(scene, std::move(quad), material);
}

// A closed axis-aligned box whose fronts face inwards.
inline Scene make_box(const glm::vec3& half, const Material& material) {
  Scene scene;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      glm::vec3 corner = -half;
      glm::vec3 a(0.0f), b(0.0f);
      corner[axis] = side * half[axis];
      a[(axis + 1) % 3] = 2.0f * half[(axis + 1) % 3];
      b[(axis + 2) % 3] = 2.0f * half[(axis + 2) % 3];
      if (side > 0.0f) std::swap(a, b);
      add_quad(scene, corner, a, b, material);
    }
  }
  return scene;
}

// ---- lights ----

inline WorldLight make_point_light(const glm::vec3& position, const glm::vec3& intensity) {
  WorldLight light;
  light.position = position;
  light.intensity = intensity;
  return light;
}

inline WorldLight make_spot_light(const glm::vec3& position, const glm::vec3& direction, float inner_degrees,
                                  float outer_degrees, const glm::vec3& intensity) {
  WorldLight light = make_point_light(position, intensity);
  light.type = LightType::kSpot;
  light.direction = glm::normalize(direction);
  light.cos_inner = std::cos(inner_degrees * std::numbers::pi_v<float> / 180.0f);
  light.cos_outer = std::cos(outer_degrees * std::numbers::pi_v<float> / 180.0f);
  return light;
}

inline WorldLight make_sun(const glm::vec3& direction, const glm::vec3& irradiance) {
  WorldLight light;
  light.type = LightType::kDirectional;
  light.direction = glm::normalize(direction);
  light.intensity = irradiance;
  return light;
}

}  // namespace lightwell
