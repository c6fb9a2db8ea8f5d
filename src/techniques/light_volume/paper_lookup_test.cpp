// The look-up at pixels, on hand-made volumes and G-buffers.
#include <gtest/gtest.h>

#include <numbers>

#include "techniques/light_volume/paper_test_sh.h"
#include "techniques/light_volume/paper_test_volume.h"

namespace lightwell {
namespace {

ShaderSh sh;

struct TestPixel {
  glm::vec3 position;
  glm::vec3 normal;
  bool surface = true;
};

class PaperLookupTest : public PaperVolumeTest {
 protected:
  static ImageHandle upload_image(FrameGraph& graph, std::span<const glm::vec4> texels) {
    ImageHandle image = graph.create_image(
        "test image", {.width = static_cast<std::uint32_t>(texels.size()), .format = VK_FORMAT_R32G32B32A32_SFLOAT});
    graph.copy("stage image", graph.upload("texels", texels), image);
    return image;
  }

  // volume.light is what cells have received.
  std::vector<glm::vec4> look_up(const TestVolume& volume, const std::vector<TestPixel>& pixels, bool occlusion) {
    std::vector<glm::vec4> positions;
    std::vector<glm::vec4> normals;
    for (const TestPixel& pixel : pixels) {
      positions.emplace_back(pixel.position, pixel.surface ? 1.0f : 0.0f);
      normals.emplace_back(pixel.normal, 0.0f);
    }
    FrameGraph graph(executor().context());
    const PaperVolume handles = upload(graph, volume);
    GBuffer gbuffer;
    gbuffer.position = upload_image(graph, positions);
    gbuffer.normal = upload_image(graph, normals);
    gbuffer.width = static_cast<std::uint32_t>(pixels.size());
    gbuffer.height = 1;
    const ReadbackTicket ticket =
        graph.read_back(record_paper_lookup(graph, volume.grid, handles, handles.light, gbuffer, occlusion));
    run(graph);
    return fetch<glm::vec4>(ticket);
  }
};

const glm::vec3 kUp(0.0f, 1.0f, 0.0f);

// The same radiance from everywhere, in occupied cells only: irradiance is pi times it wherever one of the eight cells
// around is occupied, and what lies in void cells does not matter.
TEST_F(PaperLookupTest, OnlyOccupiedCellsCount) {
  TestVolume volume(8);
  volume.for_each_cell([&](glm::ivec3 c, std::size_t i) {
    const bool floor = c.y == 2;
    if (floor) volume.cells[i] = glm::vec4(kUp, 1.0f);
    volume.set_light(i, floor ? glm::vec4(2.0f / sh.kShY0, 0.0f, 0.0f, 0.0f) : glm::vec4(1e6f));
  });
  const std::vector<glm::vec4> light = look_up(volume,
                                               {{{0.41f, 0.30f, 0.37f}, kUp},
                                                {{0.02f, 0.26f, 0.99f}, glm::normalize(glm::vec3(1.0f, 2.0f, 3.0f))},
                                                {{0.5f, 0.8f, 0.5f}, kUp},
                                                {{0.41f, 0.30f, 0.37f}, kUp, false}},
                                               true);
  for (int channel = 0; channel < 3; ++channel) {
    EXPECT_NEAR(light[0][channel], 2.0 * std::numbers::pi, 1e-4);
    EXPECT_NEAR(light[1][channel], 2.0 * std::numbers::pi, 1e-4);
    EXPECT_EQ(light[2][channel], 0.0f);  // no occupied cell near
    EXPECT_EQ(light[3][channel], 0.0f);  // no surface
  }
}

// Light that falls straight down lights what looks up, and leaves black what looks down.
TEST_F(PaperLookupTest, LightFallsAgainstTheNormal) {
  TestVolume volume(8);
  const glm::vec4 falling = sh.sh_hemisphere(-kUp);
  volume.for_each_cell([&](glm::ivec3, std::size_t i) {
    volume.cells[i] = glm::vec4(kUp, 1.0f);
    volume.set_light(i, falling);
  });
  const glm::vec3 at(0.5f);
  const std::vector<glm::vec4> light = look_up(volume, {{at, kUp}, {at, -kUp}, {at, {1.0f, 0.0f, 0.0f}}}, true);
  EXPECT_NEAR(light[0].x, glm::dot(falling, sh.sh_cosine_lobe(-kUp)), 1e-4f);
  EXPECT_GE(light[1].x, 0.0f);
  EXPECT_LT(light[1].x, light[2].x);
  EXPECT_LT(light[2].x, light[0].x);
}

// Between cell centres the light is linear, and light propagation volumes look half a cell in front of the surface.
TEST_F(PaperLookupTest, InterpolatesLinearly) {
  TestVolume volume(8);
  volume.for_each_cell([&](glm::ivec3 c, std::size_t i) {
    volume.cells[i] = glm::vec4(kUp, 1.0f);
    volume.set_light(i, glm::vec4(static_cast<float>(c.y + 1), 0.0f, 0.0f, 0.0f));
  });
  const float to_irradiance = sh.sh_cosine_lobe(kUp).x;
  const glm::vec3 at(0.5f, 0.43f, 0.5f);
  const float expected = to_irradiance * ((at.y - volume.grid.origin.y) / volume.grid.cell_size + 0.5f);
  EXPECT_NEAR(look_up(volume, {{at, kUp}}, true)[0].y, expected, 1e-3f);
  EXPECT_NEAR(look_up(volume, {{at, kUp}}, false)[0].y, expected + 0.5f * to_irradiance, 1e-3f);
}

}  // namespace
}  // namespace lightwell
