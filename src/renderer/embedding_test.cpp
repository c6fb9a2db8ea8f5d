// Lightwell inside a host that owns all of Vulkan.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "lightwell/error.h"
#include "lightwell/metrics.h"
#include "passes/trace/choose_tracing.h"
#include "renderer/testing/host.h"

namespace lightwell {
namespace {

TEST(Embedding, RayQueriesOnlyWhereTheHostSaysThatItEnabledThem) {
  if (list_devices().empty()) GTEST_SKIP() << "no Vulkan device on this machine";
  const Host host;
  ASSERT_TRUE(host.works());
  HostDevice lent = host.lend();
  const bool enabled = lent.ray_query;
  {
    const DevicePtr device = wrap_device(lent);
    EXPECT_EQ(device->has_ray_query(), enabled);
    EXPECT_EQ(choose_tracing(*device) == Tracing::kRayQuery, enabled && device->summary().type != "software");
  }
  lent.ray_query = false;
  EXPECT_FALSE(wrap_device(lent)->has_ray_query());
  if (enabled) return;
  lent.ray_query = true;
  EXPECT_THROW(wrap_device(lent), InputError);
}

TEST(Embedding, FramesOfAHostSeveralInFlight) {
  if (list_devices().empty()) GTEST_SKIP() << "no Vulkan device on this machine";
  Host host;
  ASSERT_TRUE(host.works());
  const TestScene test = make_scene();
  SceneSnapshot snapshot = take_snapshot(test.scene);
  snapshot.lights.push_back(point_light({0.3f, 0.2f, 1}, glm::vec3(5)));
  const WorldCamera camera = camera_before_wall(2, 2);
  {
    const DevicePtr device = wrap_device(host.lend());
    std::vector<std::unique_ptr<HostFrame>> frames;
    for (std::uint32_t i = 0; i < kFramesInFlight; ++i) frames.push_back(std::make_unique<HostFrame>(host));
    Renderer renderer(*device, test.scene, snapshot, square_picture(kSide), kFramesInFlight);
    for (int i = 0; i < 7; ++i) {
      snapshot.lights[0].position.x = 0.1f * static_cast<float>(i);
      HostFrame& frame = *frames[static_cast<std::size_t>(i) % kFramesInFlight];
      frame.begin();  // waits for the frame before last, so that one is complete
      const RenderTarget target{frame.image, VK_FORMAT_B8G8R8A8_UNORM, VK_IMAGE_LAYOUT_UNDEFINED,
                                VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, 0.5f};
      frame.number = renderer.record(frame.commands, {&snapshot, camera}, target, frame.number).frame;
      EXPECT_EQ(frame.number, static_cast<std::uint64_t>(i) + 1);
      frame.end();
    }
    for (const auto& frame : frames) frame->wait();

    Renderer again(*device, test.scene, snapshot, square_picture(kSide));
    const Picture expected = again.render({&snapshot, camera});
    expect_same_picture(*frames[0], tone_map(expected.combined, 0.5f));
  }
  for (const std::string& message : host.messages()) ADD_FAILURE() << message;
}

}  // namespace
}  // namespace lightwell
