// Light in the published ray-traced voxels: closed forms, and what must agree with what.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <glm/gtc/constants.hpp>

#include "shaders/surface_point.h"
#include "techniques/ray_traced_voxels/paper_replay.h"
#include "techniques/ray_traced_voxels/paper_test_frame.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kSide = 32;
const glm::vec3 kDown(0.0f, -1.0f, 0.0f);

class PaperLight : public PaperStagesTest {
 protected:
  // Irradiance of make_floor() at a place, in closed form.
  static glm::vec3 floor_irradiance(const WorldLight& light, const glm::vec3& at) {
    if (light.type == LightType::kDirectional) return light.intensity * -light.direction.y;
    const glm::vec3 way = at - light.position;
    const float distance = glm::length(way);
    float part = 1.0f;
    if (light.type == LightType::kSpot) {
      const float cosine = glm::dot(way, light.direction) / distance;
      const float t = glm::clamp((cosine - light.cos_outer) / (light.cos_inner - light.cos_outer), 0.0f, 1.0f);
      part = t * t;
    }
    return light.intensity * (part * light.position.y / (distance * distance * distance));
  }

  // Places in the middle of the floor's cells, the outermost two left out.
  std::vector<glm::vec3> floor_places() const {
    std::vector<glm::vec3> places;
    const VoxelGrid cells = grid(kSide);
    for (std::uint32_t z = 2; z + 2 < kSide; ++z)
      for (std::uint32_t x = 2; x + 2 < kSide; ++x)
        places.emplace_back(cells.origin.x + (static_cast<float>(x) + 0.5f) * cells.cell_size, 0.0f,
                            cells.origin.z + (static_cast<float>(z) + 0.5f) * cells.cell_size);
    return places;
  }
};

TEST_F(PaperLight, OnAFloorIsTheClosedForm) {
  const glm::vec3 intensity(3.0f, 2.0f, 1.0f);
  for (const WorldLight& light :
       {make_light(LightType::kPoint, {0.1f, 1.0f, 0.2f}, kDown, intensity),
        make_light(LightType::kSpot, {0.1f, 1.0f, 0.2f}, kDown, intensity),
        make_light(LightType::kDirectional, {}, glm::normalize(glm::vec3(0.3f, -1.0f, 0.1f)), intensity)}) {
    load(make_floor().scene, {light});
    for (const VoxelWriter writer : kAllWriters) {
      const PaperInjection settings{.side = 512, .writer = writer, .range = 4.0f};
      const std::vector<glm::vec4> voxels = inject(kSide, settings);
      // Half a step of 8 bits. A moving average may drift by as much with every sample until the count stays at 255.
      const float quantum = settings.range / 255.0f;
      const float steps = writer == VoxelWriter::kExact ? 0.0f : writer == VoxelWriter::kAverage ? 4.0f : 1.0f;
      for (const glm::vec3& at : floor_places()) {
        const glm::vec3 truth = floor_irradiance(light, at);
        // Light changes over a voxel, and the largest and the last sample may come from its edge.
        float change = 0.0f;
        const float half = 0.5f * grid(kSide).cell_size;
        for (const glm::vec3 corner : {glm::vec3(half, 0, half), glm::vec3(-half, 0, half), glm::vec3(half, 0, -half),
                                       glm::vec3(-half, 0, -half)})
          change = std::max(change, std::abs(floor_irradiance(light, at + corner).x - truth.x));
        const bool means = writer == VoxelWriter::kAverage || writer == VoxelWriter::kExact;
        const glm::vec3 value = voxels[stored_index(grid(kSide), at)];
        // Shares of one solid angle, not of one area, make a small difference even to means.
        const float room = steps * quantum + (means ? 0.5f : 1.1f) * change + 0.008f * truth.x + 1e-3f;
        for (int k = 0; k < 3; ++k)
          ASSERT_NEAR(value[k], truth[k], room * intensity[k] / intensity.x + steps * quantum)
              << "light " << static_cast<int>(light.type) << " writer " << static_cast<int>(writer) << " at " << at.x
              << " " << at.z;
      }
    }
  }
}

TEST_F(PaperLight, OfSeveralLightsAddsUp) {
  const WorldLight one = make_light(LightType::kPoint, {0.1f, 1.0f, 0.2f}, kDown, glm::vec3(1.0f));
  const WorldLight two = make_light(LightType::kSpot, {-0.3f, 1.5f, -0.1f}, kDown, glm::vec3(2.0f));
  for (const VoxelWriter writer : {VoxelWriter::kAverage, VoxelWriter::kExact}) {
    const PaperInjection settings{.side = 128, .writer = writer, .range = 4.0f};
    std::vector<std::vector<glm::vec4>> grids;
    for (const std::vector<WorldLight>& lights : {std::vector{one}, {two}, {one, two}}) {
      load(make_floor().scene, lights);
      grids.push_back(inject(kSide, settings));
    }
    for (std::size_t i = 0; i < grids[0].size(); ++i)
      ASSERT_NEAR(grids[2][i].x, grids[0][i].x + grids[1][i].x, writer == VoxelWriter::kExact ? 1e-5 : 0.04) << i;
  }
}

TEST_F(PaperLight, ExactIsTheSameTwice) {
  load(make_room().scene, {make_light(LightType::kPoint, {0.1f, 0.3f, 0.2f}, kDown, glm::vec3(1.0f, 2.0f, 3.0f))});
  const PaperInjection settings{.side = 256, .secondaries = 2, .writer = VoxelWriter::kExact};
  EXPECT_EQ(inject(kSide, settings), inject(kSide, settings));
}

TEST_F(PaperLight, MirroredRaysFindNothingInTheOpen) {
  load(make_floor().scene, {make_light(LightType::kSpot, {0.1f, 1.0f, 0.2f}, kDown, glm::vec3(1.0f))});
  PaperInjection settings{.side = 64, .writer = VoxelWriter::kExact};
  const std::vector<glm::vec4> without = inject(kSide, settings);
  settings.secondaries = 3;
  EXPECT_EQ(inject(kSide, settings), without);
}

// From a narrow spot straight down to the floor, and from there straight up to the ceiling: E2 = rho E1 / t^2.
TEST_F(PaperLight, MirroredRaysFallOffAgain) {
  WorldLight spot = make_light(LightType::kSpot, {0.03f, 1.0f, 0.03f}, kDown, glm::vec3(1.0f));
  spot.cos_inner = 0.9999f;
  spot.cos_outer = 0.999f;
  const glm::vec3 albedo(0.8f, 0.5f, 0.2f);
  load(make_room(albedo).scene, {spot});
  for (const bool through_voxels : {false, true}) {
    const std::vector<glm::vec4> voxels =
        inject(kSide, {.side = 128, .secondaries = 1, .through_voxels = through_voxels, .writer = VoxelWriter::kExact});
    const glm::vec3 value = voxels[stored_index(grid(kSide), {0.03f, 2.0f, 0.03f})];
    // The floor is two cells thick there, the ceiling one and lower by one: both ways are shorter than they should be.
    const float room = through_voxels ? 0.45f : 0.02f;
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(value[k] / (albedo[k] / 4.0f), 1.0f, room);
  }
}

TEST_F(PaperLight, CameraAndLightAgreeOnWhatIsSeen) {
  load(make_floor().scene, {make_light(LightType::kPoint, {0.1f, 1.0f, 0.2f}, kDown, glm::vec3(3.0f, 2.0f, 1.0f)),
                            make_light(LightType::kDirectional, {}, kDown, glm::vec3(0.5f))});
  const WorldCamera camera = look_from({0.0f, 1.2f, 0.0f}, kDown, {0, 0, 1});
  const PaperInjection settings{.side = 512, .writer = VoxelWriter::kExact};
  const std::vector<glm::vec4> from_lights = inject(kSide, settings);
  const std::vector<glm::vec4> from_camera = inject(kSide, settings, &camera);
  double worst = 0.0;
  int seen = 0;
  for (const glm::vec3& at : floor_places()) {
    const std::uint32_t voxel = stored_index(grid(kSide), at);
    if (from_camera[voxel].x == 0.0f || glm::length(glm::vec2(at.x, at.z)) > 0.7f) continue;
    worst = std::max(worst, std::abs(double{from_camera[voxel].x} / from_lights[voxel].x - 1.0));
    ++seen;
  }
  EXPECT_GT(seen, 300);
  EXPECT_LT(worst, 0.03);
}

// What a mirrored ray of the camera finds counts where the camera looks: here a lit floor in a dark ceiling.
TEST_F(PaperLight, MirroredCameraRaysCountForTheFirstHit) {
  WorldLight spot = make_light(LightType::kSpot, {0.03f, 1.0f, 0.03f}, kDown, glm::vec3(1.0f));
  load(make_room(glm::vec3(0.5f)).scene, {spot});
  const WorldCamera camera = look_from({0.0f, 0.8f, 0.0f}, {0, 1, 0}, {0, 0, 1});
  PaperInjection settings{.side = 256, .writer = VoxelWriter::kExact};
  const std::uint32_t voxel = stored_index(grid(kSide), {0.03f, 2.0f, 0.03f});
  EXPECT_EQ(inject(kSide, settings, &camera)[voxel].x, 0.0f);
  settings.secondaries = 1;
  EXPECT_NEAR(inject(kSide, settings, &camera)[voxel].x, 0.5 * 1.0 / 4.0, 0.005);  // rho E cos / t^2
}

TEST_F(PaperLight, ThroughVoxelsIsNearlyThatOfTriangles) {
  load(make_floor().scene, {make_light(LightType::kPoint, {0.1f, 1.0f, 0.2f}, kDown, glm::vec3(3.0f))});
  PaperInjection settings{.side = 512, .writer = VoxelWriter::kExact};
  const std::vector<glm::vec4> triangles = inject(kSide, settings);
  settings.through_voxels = true;
  const std::vector<glm::vec4> voxels = inject(kSide, settings);
  double sum = 0.0;
  double truth = 0.0;
  for (const glm::vec3& at : floor_places()) {
    sum += voxels[stored_index(grid(kSide), at)].x;
    truth += triangles[stored_index(grid(kSide), at)].x;
  }
  EXPECT_NEAR(sum / truth, 1.0, 0.15);  // the floor is two cells of 1/16 m thick
}

TEST_F(PaperLight, RangeIsWhatTheBrightestLightGives) {
  const Bounds bounds{{-1, 0, -1}, {1, 2, 1}};
  const auto range = [&](const WorldLight& light) { return choose_irradiance_range({&light, 1}, bounds); };
  EXPECT_EQ(choose_irradiance_range({}, bounds), 1.0f);
  EXPECT_FLOAT_EQ(range(make_light(LightType::kDirectional, {}, kDown, {1, 5, 2})), 5.0f);
  EXPECT_FLOAT_EQ(range(make_light(LightType::kSpot, {0, 1.5f, 0}, kDown, {9, 1, 1})), 4.0f);
  EXPECT_FLOAT_EQ(range(make_light(LightType::kPoint, {0, 1, 0}, kDown, {3, 1, 1})), 3.0f);
  EXPECT_FLOAT_EQ(range(make_light(LightType::kPoint, {0.2f, 1.9f, 0}, kDown, {1, 1, 1})), 1.0f);  // .1 .8 1 1 ..
  EXPECT_FLOAT_EQ(range(make_light(LightType::kPoint, {0, 11, 0}, kDown, {100, 1, 1})), 1.0f);
  const WorldLight black = make_light(LightType::kPoint, {0, 1, 0}, kDown, glm::vec3(0.0f));
  EXPECT_EQ(range(black), 1.0f);
}

TEST_F(PaperLight, PicturesByAverageAndExactAreAlike) {
  load(make_room().scene, {make_light(LightType::kSpot, {0.1f, 1.2f, 0.2f}, kDown, glm::vec3(1.0f))});
  const WorldCamera camera = look_from({0, 1.9f, 0.9f}, {0, -1, -0.5f}, {0, 0.5f, -1});
  for (const VoxelInjection injection : {VoxelInjection::kLight, VoxelInjection::kCamera}) {
    double sums[2] = {};
    for (const VoxelWriter writer : {VoxelWriter::kAverage, VoxelWriter::kExact}) {
      const auto [irradiance, position] =
          picture({.resolution = 32, .rays = 128, .writer = writer, .inject = injection, .ambient = 0.0f}, camera);
      for (const glm::vec4& e : irradiance) sums[writer == VoxelWriter::kExact ? 1 : 0] += e.x;
    }
    EXPECT_GT(sums[0], 0.0);
    EXPECT_NEAR(sums[1] / sums[0], 1.0, 0.03);
  }
}

TEST_F(PaperLight, NoLightLeavesTheAmbientOne) {
  load(make_room().scene, {});
  const WorldCamera camera = look_from({0, 1, 0.5f}, {0, 0, -1}, {0, 1, 0});
  for (const VoxelInjection injection : {VoxelInjection::kLight, VoxelInjection::kCamera}) {
    const auto [irradiance, position] =
        picture({.resolution = 16, .rays = 16, .inject = injection, .irradiance_range = 5.0f, .ambient = 0.3f}, camera);
    for (std::size_t i = 0; i < irradiance.size(); ++i)
      EXPECT_NEAR(irradiance[i].x, position[i].w > 0.0f ? 0.3f * glm::pi<float>() * 5.0f : 0.0f, 1e-4f);
  }
}

// Nothing that is not a number comes out, whatever goes in.
TEST_F(PaperLight, SurvivesHugeAndDegenerateScenes) {
  const WorldCamera camera = look_from({0, 1, 0.5f}, {0, 0, -1}, {0, 1, 0});
  QuadScene broken = make_room();
  broken.scene.meshes[3].primitives[0].positions[1].x = std::numeric_limits<float>::quiet_NaN();
  QuadScene huge = make_room();
  for (Mesh& mesh : huge.scene.meshes)
    for (glm::vec3& corner : mesh.primitives[0].positions) corner *= 1e8f;
  QuadScene point;
  point.add_quad({1, 1, 1}, {0, 0, 0}, {0, 0, 0}, point.add_material(glm::vec3(0.5f)));
  point.scene.meshes[0].primitives[0].normals.assign(4, {0, 1, 0});
  for (const Scene& scene : {broken.scene, huge.scene, point.scene}) {
    load(scene, {make_light(LightType::kPoint, {0, 0, 0}, kDown, glm::vec3(1e18f)),
                 make_light(LightType::kDirectional, {}, kDown, glm::vec3(1e-18f))});
    for (const VoxelWriter writer : kAllWriters) {
      for (const VoxelInjection injection : {VoxelInjection::kLight, VoxelInjection::kCamera}) {
        for (const bool trace_voxels : {false, true}) {
          const auto [irradiance, position] = picture({.resolution = 16,
                                                       .rays = 24,
                                                       .writer = writer,
                                                       .inject = injection,
                                                       .secondaries = 2,
                                                       .trace_voxels = trace_voxels},
                                                      camera);
          for (const glm::vec4& e : irradiance) ASSERT_TRUE(std::isfinite(e.x + e.y + e.z));
        }
      }
    }
  }
}

// A random grid: one tap is linear interpolation as textures do it, seven taps are the mean of it at seven places.
TEST_F(PaperLight, TapsAreMeansOfInterpolation) {
  constexpr std::uint32_t kCells = 8;
  load(make_room().scene, {});
  const VoxelGrid cells = grid(kCells);
  std::mt19937 random(3);
  std::vector<std::uint32_t> words(cells.cell_count);
  for (std::uint32_t& word : words) word = random();
  std::uniform_real_distribution<float> uniform(-1.2f, 1.2f);
  std::vector<glsl::SurfacePoint> places;
  const std::array<glm::vec3, 7> offsets{glm::vec3(0), {1, 0, 0}, {-1, 0, 0}, {0, 1, 0},
                                         {0, -1, 0},   {0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < 50; ++i) {
    const glm::vec3 place(uniform(random), 1.0f + uniform(random), uniform(random));
    for (const glm::vec3& offset : offsets) places.push_back({glm::vec4(place + offset * cells.cell_size, 1.0f), {}});
  }
  std::array<ReadbackTicket, 2> tickets;
  frame([&](FrameGraph& graph, WorldFrame&) {
    const PaperIrradiance irradiance{cells, graph.upload<std::uint32_t>("words", words), false, 2.0f};
    const Points points{graph.upload<glsl::SurfacePoint>("points", places), static_cast<std::uint32_t>(places.size())};
    tickets[0] = graph.read_back(record_paper_points(graph, irradiance, points, {.taps = 1, .ambient = 0.0f}));
    tickets[1] = graph.read_back(record_paper_points(graph, irradiance, points, {.taps = 7, .ambient = 0.1f}));
  });
  const auto ones = fetch<glm::vec4>(tickets[0]);
  const auto sevens = fetch<glm::vec4>(tickets[1]);
  const float ambient = 0.1f * glm::pi<float>() * 2.0f;
  for (std::size_t i = 0; i < places.size(); i += offsets.size()) {
    glm::vec4 mean(0.0f);
    for (std::size_t k = 0; k < offsets.size(); ++k) mean += ones[i + k] / 7.0f;
    EXPECT_NEAR(sevens[i].x - ambient, mean.x, 1e-5f);
    const glm::vec3 place = (glm::vec3(places[i].position) - cells.origin) / cells.cell_size - 0.5f;
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::ivec3 offset(corner & 1, corner >> 1 & 1, corner >> 2);
      const glm::ivec3 cell = glm::clamp(glm::ivec3(glm::floor(place)) + offset, glm::ivec3(0), glm::ivec3(kCells - 1));
      const glm::vec3 part = glm::mix(1.0f - glm::fract(place), glm::fract(place), glm::vec3(offset));
      sum += part.x * part.y * part.z * 2.0f * unpack(words[(cell.z * kCells + cell.y) * kCells + cell.x]).x;
    }
    EXPECT_NEAR(ones[i].x, sum, 1e-4);
  }
}

}  // namespace
}  // namespace lightwell
