// Splats made by hand, and surfaces that a camera sees, for tests.
#pragma once

#include <cmath>
#include <cstring>
#include <functional>
#include <vector>

#include <glm/geometric.hpp>

#include "graph/testing/graph_test.h"
#include "passes/camera/camera.h"
#include "techniques/photon_splatting/splat_passes.h"
#include "techniques/photon_splatting/splat_storage.h"

namespace lightwell {

struct TestHit {
  float distance = 0.0f;  // 0: nothing
  glm::vec3 normal{0.0f};
};

// What a ray from `origin` along the unit `direction` meets.
using TestWorld = std::function<TestHit(const glm::vec3& origin, const glm::vec3& direction)>;

inline float sign_of(float v) {
  return v < 0.0f ? -1.0f : 1.0f;
}

// As octahedral.glsl has it.
inline glm::vec2 to_octahedron(const glm::vec3& v) {
  const glm::vec2 p = glm::vec2(v) / (std::abs(v.x) + std::abs(v.y) + std::abs(v.z));
  if (v.z >= 0.0f) return p;
  return (1.0f - glm::vec2(std::abs(p.y), std::abs(p.x))) * glm::vec2(sign_of(p.x), sign_of(p.y));
}

struct SeenPoint {
  glm::vec4 position{0.0f};
  glm::vec4 normal{0.0f};
};

struct TestScreen {
  glm::uvec2 size{64};
  WorldCamera camera;
  std::vector<SeenPoint> points;  // a pixel each

  TestScreen(glm::uvec2 picture_size, const WorldCamera& world_camera, const TestWorld& world)
      : size(picture_size), camera(world_camera) {
    const glsl::GpuCamera gpu = gpu_camera();
    for (std::uint32_t y = 0; y < size.y; ++y)
      for (std::uint32_t x = 0; x < size.x; ++x) {
        const glm::vec2 ndc = 2.0f * (glm::vec2(x, y) + 0.5f) / glm::vec2(size) - 1.0f;
        const glm::vec3 direction =
            glm::normalize(gpu.forward + ndc.x * gpu.tan_half_x * gpu.right - ndc.y * gpu.tan_half_y * gpu.up);
        const TestHit hit = world(camera.position, direction);
        SeenPoint point;
        if (hit.distance > 0.0f) {
          const glm::vec3 offset = hit.distance * direction;
          point.position = glm::vec4(camera.position + offset, glm::dot(offset, gpu.forward));
          point.normal = glm::vec4(hit.normal, 0.0f);
        }
        points.push_back(point);
      }
  }

  glsl::GpuCamera gpu_camera() const { return make_gpu_camera(camera, size, {}, nullptr); }

  SplatScreen upload(FrameGraph& graph) const {
    std::vector<glm::vec4> position, normal, face;
    for (const SeenPoint& point : points) {
      position.push_back(point.position);
      normal.push_back(point.normal);
      face.emplace_back(to_octahedron(point.position.w > 0.0f ? glm::vec3(point.normal) : glm::vec3(0, 0, 1)), 1.0f,
                        0.0f);
    }
    SplatScreen screen;
    screen.camera = gpu_camera();
    screen.camera_buffer = graph.upload<glsl::GpuCamera>("camera", {&screen.camera, 1});
    screen.gbuffer.position = upload_image(graph, position);
    screen.gbuffer.normal = upload_image(graph, normal);
    screen.gbuffer.face = upload_image(graph, face);
    screen.gbuffer.width = size.x;
    screen.gbuffer.height = size.y;
    return screen;
  }

 private:
  ImageHandle upload_image(FrameGraph& graph, const std::vector<glm::vec4>& texels) const {
    ImageHandle image =
        graph.create_image("test image", {.width = size.x, .height = size.y, .format = VK_FORMAT_R32G32B32A32_SFLOAT});
    graph.copy("stage image", graph.upload<glm::vec4>("texels", texels), image);
    return image;
  }
};

inline glsl::Splat make_splat(const glm::vec3& center, const glm::vec3& direction, float half_width,
                              const glm::vec3& normal) {
  return {.center = center,
          .half_width = half_width,
          .direction = glm::normalize(direction),
          .reach = 2.0f * half_width,
          .flux = glm::vec3(1.0f),
          .photons = 1.0f,
          .accepted = 1.0f,
          .map = 0,
          .normal = pack_unit_vector(normal)};
}

// As hemisphere.glsl has it; third: `normal`.
inline glm::mat3 test_frame_about(const glm::vec3& normal) {
  const float side = sign_of(normal.z);
  const float a = -1.0f / (side + normal.z);
  const float b = normal.x * normal.y * a;
  return {glm::vec3(1.0f + side * normal.x * normal.x * a, side * b, -side * normal.x),
          glm::vec3(b, side + normal.y * normal.y * a, -normal.y), normal};
}

// Splats with their maps, number i that of splat i: parallel rays through the world, from the plane at -reach.
class TestSplats {
 public:
  explicit TestSplats(const TestWorld& world, std::uint32_t map_side = 4) : world_(world), map_side_(map_side) {}

  // `tests_receivers`: texels that meet no surface like that at the center hold 0 and are not accepted.
  void add(const glsl::Splat& given, bool tests_receivers = false, SplatKernel kernel = SplatKernel::kBox) {
    constexpr float kLeastLikeness = 0.6f;
    const auto map = static_cast<std::uint32_t>(splats_.size());
    const glsl::Splat splat = load_splat(store_splat(given), map);
    const glm::vec3 normal = unpack_unit_vector(splat.normal);
    float accepted = 0.0f;
    float all = 0.0f;
    splats_.push_back(splat);
    const glm::mat3 frame = test_frame_about(splat.direction);
    for (std::uint32_t y = 0; y < map_side_; ++y)
      for (std::uint32_t x = 0; x < map_side_; ++x) {
        const glm::vec2 place = (2.0f * glm::vec2(x, y) + 1.0f) / static_cast<float>(map_side_) - 1.0f;
        const glm::vec3 start =
            splat.center + splat.half_width * (place.x * frame[0] + place.y * frame[1]) - splat.reach * splat.direction;
        const TestHit hit = world_(start, splat.direction);
        const bool accepts = hit.distance > 0.0f && glm::dot(hit.normal, normal) > kLeastLikeness;
        all += texel_weight(kernel, x, y, map_side_);
        accepted += accepts ? texel_weight(kernel, x, y, map_side_) : 0.0f;
        maps_.push_back(tests_receivers && !accepts ? 0.0f : hit.distance > 0.0f ? hit.distance : 1e30f);
      }
    if (tests_receivers) splats_.back().accepted = accepted / all;
  }

  const std::vector<glsl::Splat>& splats() const { return splats_; }

  // `capacity` of the buffer; at least as many as there are.
  Splats upload(FrameGraph& graph, std::uint32_t capacity = 0) const {
    std::vector<glsl::StoredSplat> splats;
    for (const glsl::Splat& splat : splats_) splats.push_back(store_splat(splat));
    splats.resize(std::max<std::size_t>({splats.size(), capacity, 1}));
    const std::vector<std::uint32_t> counts{static_cast<std::uint32_t>(splats_.size()), 0, 0, 0};
    Splats result;
    result.capacity = static_cast<std::uint32_t>(splats.size());
    result.splats = graph.upload<glsl::StoredSplat>("splats", splats);
    result.counts = graph.upload<std::uint32_t>("splat counts", counts);
    result.map_side = map_side_;
    result.maps_per_row = 32;
    const std::uint32_t rows = (result.capacity + result.maps_per_row - 1) / result.maps_per_row;
    const std::uint32_t width = result.maps_per_row * map_side_;
    std::vector<float> atlas(std::size_t{width} * rows * map_side_, 1e30f);
    for (std::uint32_t i = 0; i < maps_.size(); ++i) {
      const std::uint32_t map = i / (map_side_ * map_side_);
      const std::uint32_t texel = i % (map_side_ * map_side_);
      const std::uint32_t x = map % result.maps_per_row * map_side_ + texel % map_side_;
      const std::uint32_t y = map / result.maps_per_row * map_side_ + texel / map_side_;
      atlas[std::size_t{y} * width + x] = maps_[i];
    }
    result.shadow_atlas =
        graph.create_image("test atlas", {.width = width, .height = rows * map_side_, .format = VK_FORMAT_R32_SFLOAT});
    graph.copy("stage atlas", graph.upload<float>("texels", atlas), result.shadow_atlas);
    return result;
  }

 private:
  TestWorld world_;
  std::uint32_t map_side_;  // texels
  std::vector<glsl::Splat> splats_;
  std::vector<float> maps_;
};

class SplatTest : public GraphTest {
 protected:
  static constexpr std::uint64_t kMemory = 8 << 20;

  // Entries of the lists in the last call, and the shift by which they were thinned.
  glm::uvec2 total_{0};

  std::vector<glm::vec4> gather(const TestScreen& screen, const TestSplats& splats, const SplatRules& rules,
                                std::uint64_t memory = kMemory) {
    FrameGraph graph(executor().context());
    const SplatScreen seen = screen.upload(graph);
    const Splats uploaded = splats.upload(graph);
    const SplatLists lists =
        record_splat_lists(graph, seen, uploaded, rules.estimate, memory, std::make_shared<bool>(true));
    const ReadbackTicket ticket = graph.read_back(record_splat_gather(graph, seen, uploaded, lists, rules));
    const ReadbackTicket totals = graph.read_back(lists.totals);
    run(graph);
    total_ = fetch<glm::uvec2>(totals).at(0);
    return fetch<glm::vec4>(ticket);
  }

  // Each tile's list is that of all splats.
  std::vector<glm::vec4> gather_all(const TestScreen& screen, const TestSplats& splats, const SplatRules& rules) {
    FrameGraph graph(executor().context());
    const SplatScreen seen = screen.upload(graph);
    const auto count = static_cast<std::uint32_t>(splats.splats().size());
    const glm::uvec2 tiles = (screen.size + glsl::kSplatTile - 1u) / glsl::kSplatTile;
    std::vector<std::uint32_t> entries(count);
    for (std::uint32_t i = 0; i < count; ++i) entries[i] = i;
    const std::vector<glm::uvec2> ranges(std::size_t{tiles.x} * tiles.y, glm::uvec2(0, count));
    const std::vector<glm::uvec2> none(1, glm::uvec2(0));
    const SplatLists lists{graph.upload<glm::uvec2>("ranges", ranges), graph.upload<std::uint32_t>("entries", entries),
                           graph.upload<glm::uvec2>("totals", none)};
    const ReadbackTicket ticket = graph.read_back(record_splat_gather(graph, seen, splats.upload(graph), lists, rules));
    run(graph);
    return fetch<glm::vec4>(ticket);
  }
};

}  // namespace lightwell
