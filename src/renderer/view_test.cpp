// Several views of one world in one frame: what they share is recorded once, and each looks as if it were alone.
#include "renderer/view.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <glm/ext/vector_float4.hpp>

#include "gpu/submit.h"
#include "graph/testing/graph_test.h"
#include "passes/combine/combine.h"

namespace lightwell {
namespace {

constexpr int kFrames = 12;

RendererOptions options_of(int width, int height, std::string technique = "light-volume") {
  RendererOptions options;
  options.width = width;
  options.height = height;
  options.technique = std::move(technique);
  return options;
}

// What the frames of some views of one scene came to.
struct Outcome {
  std::vector<double> means;                    // radiance, one a view
  std::map<std::string, std::uint32_t> counts;  // of passes by name, of the last frame
  std::map<std::string, std::uint64_t> memory;  // bytes by name
};

class ViewsTest : public GraphTest {
 protected:
  // With an executor of its own, so that no history is another run's.
  Outcome run_views(const std::vector<RendererOptions>& options, const std::vector<WorldCamera>& cameras) {
    SetUp();
    frame_ = 0;
    const SceneSnapshot snapshot = take_snapshot(scene_);
    Outcome outcome;
    {
      SharedWorld shared(device(), scene_, snapshot, options[0]);
      std::vector<std::unique_ptr<View>> views;
      for (std::size_t i = 0; i < options.size(); ++i)
        views.push_back(std::make_unique<View>(shared, "view " + std::to_string(i + 1) + ": ", options[i]));
      std::vector<ReadbackTicket> tickets;
      for (int frame = 0; frame < kFrames; ++frame) {
        FrameGraph graph(executor().context());
        WorldFrame world(graph, shared.world(), snapshot, 0.0);
        tickets.clear();
        for (std::size_t i = 0; i < views.size(); ++i) {
          const DeclaredView declared = views[i]->declare(graph, world, cameras[i], false, {});
          tickets.push_back(graph.read_back(record_combine(graph, declared.gbuffer, declared.parts)));
        }
        run(graph);
      }
      for (const ReadbackTicket& ticket : tickets) outcome.means.push_back(mean(fetch<glm::vec4>(ticket)));
      for (const PassTime& pass : executor().pass_times(frame_)) outcome.counts[pass.name] = pass.count;
      for (const auto& [name, use] : device().memory().report()) outcome.memory[name] = use.bytes;
    }
    return outcome;
  }

  Outcome run_alone(const RendererOptions& options, const WorldCamera& camera) {
    return run_views({options}, {camera});
  }

  static double mean(const std::vector<glm::vec4>& texels) {
    double sum = 0.0;
    for (const glm::vec4& t : texels) sum += (t.r + t.g + t.b) / 3.0;
    return sum / static_cast<double>(texels.size());
  }

  WorldCamera camera(int index) {
    WorldCamera camera = take_snapshot(scene_).cameras.at(0);
    camera.position += 0.2f * static_cast<float>(index) * glm::vec3(1.0f, 0.5f, 0.0f);
    return camera;
  }

  Scene scene_ = load_scene(LIGHTWELL_SOURCE_DIR "/scenes/cornell-box.gltf");
};

// Two cameras, then two sizes: the light of both equals that of two runs.
TEST_F(ViewsTest, LookAsIfTheyWereAlone) {
  const std::vector<RendererOptions> sizes{options_of(48, 48), options_of(64, 40)};
  for (const bool two_sizes : {false, true}) {
    const std::vector<RendererOptions> options{sizes[0], sizes[two_sizes ? 1 : 0]};
    const Outcome together = run_views(options, {camera(0), camera(1)});
    for (int i = 0; i < 2; ++i) {
      const Outcome alone = run_alone(options[static_cast<std::size_t>(i)], camera(i));
      EXPECT_GT(alone.means[0], 0.01);
      EXPECT_NEAR(together.means[static_cast<std::size_t>(i)] / alone.means[0], 1.0, 0.01) << "view " << i;
    }
  }
}

TEST_F(ViewsTest, ShareTheWorldPart) {
  const Outcome alone = run_alone(options_of(48, 48), camera(0));
  const Outcome together = run_views({options_of(48, 48), options_of(48, 48)}, {camera(0), camera(1)});
  for (const char* once : {"light cache: gather", "light cache: solve"})
    EXPECT_EQ(together.counts.at(once), alone.counts.at(once));
  for (const char* twice : {"light cache: look-up", "g-buffer", "reproject", "sample lights"})
    EXPECT_EQ(together.counts.at(twice), 2 * alone.counts.at(twice)) << twice;

  // The second view's histories are its own; the world's are there once, of the same size.
  const auto of_view = [](const Outcome& outcome, const std::string& prefix) {
    std::uint64_t bytes = 0;
    for (const auto& [name, size] : outcome.memory)
      if (name.starts_with(prefix)) bytes += size;
    return bytes;
  };
  EXPECT_GT(of_view(alone, "view 1: "), 0u);
  EXPECT_EQ(of_view(together, "view 2: "), of_view(together, "view 1: "));
  EXPECT_GT(of_view(alone, "light-volume: "), 0u);
  EXPECT_EQ(of_view(together, "light-volume"), of_view(alone, "light-volume"));
}

// Views whose options for the world differ have parts of their own.
TEST_F(ViewsTest, WithOtherOptionsOfTheWorldHaveTheirOwnPart) {
  RendererOptions fine = options_of(48, 48);
  fine.technique_options = {"resolution=16"};
  const Outcome together = run_views({options_of(48, 48), fine}, {camera(0), camera(0)});
  EXPECT_GT(together.memory.at("light-volume: face light"), 0u);
  EXPECT_GT(together.memory.at("light-volume 2: face light"), 0u);
}

// Techniques without a world part, and none at all, stand side by side.
TEST_F(ViewsTest, NeedNoWorldPart) {
  const Outcome together =
      run_views({options_of(32, 32, "ambient"), options_of(32, 32, "none")}, {camera(0), camera(0)});
  EXPECT_GT(together.means[0], together.means[1]);
}

// What moved since the last picture counts from the last frame that was recorded, whatever was declared in between.
TEST_F(ViewsTest, AFrameThatIsDroppedIsNoLastFrame) {
  const SceneSnapshot snapshot = take_snapshot(scene_);
  SharedWorld shared(device(), scene_, snapshot, options_of(16, 16, "none"));
  View view(shared, "", options_of(16, 16, "none"));
  double time_step = 0.0;
  std::optional<ReadbackTicket> motion;
  const auto show = [&](int camera_index, double time, bool recorded) {
    FrameGraph graph(executor().context());
    WorldFrame world(graph, shared.world(), snapshot, time);
    time_step = world.time_step;
    const DeclaredView declared = view.declare(graph, world, camera(camera_index), false, {});
    motion = graph.read_back(declared.gbuffer.motion);
    if (recorded) run(graph);
  };
  show(0, 1.0, true);
  show(1, 2.0, false);
  show(1, 4.0, true);
  EXPECT_EQ(time_step, 3.0);
  const std::vector<std::uint32_t> texels = fetch<std::uint32_t>(*motion);  // two 16-bit floats each
  EXPECT_NE(texels[16 * 8 + 8], 0u);
}

}  // namespace
}  // namespace lightwell
