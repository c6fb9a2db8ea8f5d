// Measures what each writer costs over the same hits; not part of the test run:
//   lightwell_techniques_test --gtest_also_run_disabled_tests --gtest_filter='*PaperWritersBench.*'
#include <gtest/gtest.h>

#include <cstdio>
#include <optional>
#include <string>

#include "techniques/ray_traced_voxels/paper_replay.h"
#include "techniques/ray_traced_voxels/paper_test_frame.h"

namespace lightwell {
namespace {

// A closed room of 2 m a side. Lights: a spot that looks at the floor from 1 m (far) or 5 cm (near), as in the source's
// tables 7.2 to 7.4; and a point in the middle, which spreads as many rays over all walls.
struct Place {
  const char* name;
  LightType type;
  float height;
};

class PaperWritersBench : public PaperStagesTest, public ::testing::WithParamInterface<Place> {};

TEST_P(PaperWritersBench, DISABLED_ReplayedHits) {
  const Place& place = GetParam();
  constexpr int kRepeats = 7;
  std::printf("write: ms, and in parts of the unsynchronised writer's; +: clearing and means, ms\n");
  std::printf("%5s %5s %5s %9s %18s %18s %18s %12s %12s\n", "light", "grid", "rays", "none", "average", "maximum",
              "exact", "none +", "exact +");
  for (const std::uint32_t resolution : {64u, 128u, 256u}) {
    for (const std::uint32_t side : {256u, 512u, 1024u, 2048u}) {
      load(make_room().scene,
           {make_light(place.type, {0.1f, place.height, 0.2f}, {0, -1, 0}, glm::vec3(1.0f, 0.9f, 0.8f))});
      std::optional<WorldFrame> world;
      HitReplay replay(device(), paper_hit_count(side), grid(resolution).cell_count, 1.0f, [&](FrameGraph& graph) {
        world.emplace(graph, *world_, snapshot_, 0.0);
        ExactSums none;
        const PaperMaterials materials =
            record_paper_materials(graph, world->scene, grid(resolution), VoxelWriter::kMaximum, none);
        return record_light_hits(graph, *world, materials, {.side = side}, 0);
      });
      const std::array<ReplayTime, 4> times = replay.time(kRepeats);
      const auto of = [&](VoxelWriter writer) { return times[static_cast<std::size_t>(writer)]; };
      const double none = of(VoxelWriter::kNone).write_ms;
      const auto print = [&](VoxelWriter writer) {
        std::printf(" %9.3f (%5.2f)", of(writer).write_ms, of(writer).write_ms / none);
      };
      std::printf("%5s %5u %5u %9.3f ", place.name, resolution, side, none);
      print(VoxelWriter::kAverage);
      print(VoxelWriter::kMaximum);
      print(VoxelWriter::kExact);
      std::printf(" %12.3f %12.3f\n", of(VoxelWriter::kNone).rest_ms, of(VoxelWriter::kExact).rest_ms);
      std::fflush(stdout);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Places, PaperWritersBench,
                         ::testing::Values(Place{"far", LightType::kSpot, 1.0f}, Place{"near", LightType::kSpot, 0.05f},
                                           Place{"point", LightType::kPoint, 1.0f}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace lightwell
