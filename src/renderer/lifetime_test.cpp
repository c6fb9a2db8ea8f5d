// Renderers come and go on one device, two at a time, frames in flight: nothing piles up, on the GPU or in the host.
#include <gtest/gtest.h>

#include <unistd.h>

#include <array>
#include <fstream>
#include <memory>

#include <glm/ext/matrix_transform.hpp>

#include "gpu/device.h"
#include "renderer/testing/host.h"

namespace lightwell {
namespace {

constexpr int kLifetime = 20;  // frames of one renderer

// All kinds of memory: textures, what moves, lights with shadow maps, an emitter, an environment.
TestScene make_rich_scene() {
  TestScene test = make_scene();
  Texture& texture = test.scene.textures.emplace_back();
  texture.width = texture.height = 64;
  texture.rgba.assign(4 * 64 * 64, 200);
  test.scene.materials[0].base_color_texture.texture = 0;
  test.add_quad({-0.3f, 0.9f, 0.2f}, {0.6f, 0, 0}, {0, 0, 0.6f}, test.add_material(glm::vec3(0.0f), glm::vec3(4.0f)));
  test.scene.environment.radiance = glm::vec3(0.2f);
  return test;
}

// A renderer and its host's frames in flight.
class Guest {
 public:
  Guest(const Host& host, Device& device, const TestScene& test, const SceneSnapshot& snapshot, bool second_kind)
      : frames_{HostFrame(host), HostFrame(host)}, renderer_(device, test.scene, snapshot, options_of(second_kind)) {}
  ~Guest() {
    for (HostFrame& frame : frames_) frame.wait();
  }

  void run_frame(const SceneSnapshot& snapshot) {
    HostFrame& frame = frames_[turn_++ % kFramesInFlight];
    frame.begin();
    const RenderTarget target{frame.image, VK_FORMAT_B8G8R8A8_UNORM, VK_IMAGE_LAYOUT_UNDEFINED,
                              VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, 1.0f};
    frame.number = renderer_.record(frame.commands, {&snapshot, camera_before_wall(2, 2)}, target, frame.number).frame;
    frame.end();
  }

 private:
  static RendererOptions options_of(bool second_kind) {
    RendererOptions options = square_picture(static_cast<int>(kSide));
    options.technique = second_kind ? "ambient" : "light-volume";
    options.shadows = second_kind ? 1 : 0;
    options.shadow_map_size = 64;
    return options;
  }

  std::array<HostFrame, kFramesInFlight> frames_;
  Renderer renderer_;
  std::size_t turn_ = 0;
};

struct Held {
  std::uint64_t device_bytes = 0;
  std::uint64_t reserved_bytes = 0;
  double resident_mib = 0.0;
};

Held measure(Device& device) {
  std::uint64_t total_pages = 0;
  std::uint64_t resident_pages = 0;
  std::ifstream("/proc/self/statm") >> total_pages >> resident_pages;
  return {device.memory().total_bytes(), device.memory().reserved_bytes(),
          static_cast<double>(resident_pages) * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1 << 20)};
}

// One of the two renderers is replaced every kLifetime / 2 frames, so that the other one has frames in flight then.
// What is held after `warm_up` frames is what is held at the end; both are multiples of kLifetime.
void run_frames(int warm_up, int frame_count) {
  if (list_devices().empty()) GTEST_SKIP() << "no Vulkan device on this machine";
  const Host host(false);
  ASSERT_TRUE(host.works());
  const TestScene test = make_rich_scene();
  SceneSnapshot snapshot = take_snapshot(test.scene);
  snapshot.lights.push_back(point_light({0.3f, 0.2f, 1}, glm::vec3(5)));
  const DevicePtr device = wrap_device(host.lend());
  std::array<std::unique_ptr<Guest>, 2> guests;
  Held start;
  for (int frame = 0; frame < frame_count; ++frame) {
    if (frame == warm_up) start = measure(*device);
    if (frame % (kLifetime / 2) == 0) {
      const std::size_t which = static_cast<std::size_t>(frame / (kLifetime / 2)) % 2;
      guests[which].reset();
      guests[which] = std::make_unique<Guest>(host, *device, test, snapshot, which == 1);
    }
    snapshot.instances[1].to_world =
        glm::translate(glm::mat4(1.0f), {0.01f * static_cast<float>(frame % kLifetime), 0, 0});
    for (const auto& guest : guests)
      if (guest) guest->run_frame(snapshot);
  }
  const Held end = measure(*device);
  std::printf("frames %d: device %.2f MiB, then %.2f; reserved %.2f, then %.2f; resident %.1f, then %.1f\n",
              frame_count, static_cast<double>(start.device_bytes) / (1 << 20),
              static_cast<double>(end.device_bytes) / (1 << 20), static_cast<double>(start.reserved_bytes) / (1 << 20),
              static_cast<double>(end.reserved_bytes) / (1 << 20), start.resident_mib, end.resident_mib);
  EXPECT_EQ(end.device_bytes, start.device_bytes);
  EXPECT_EQ(end.reserved_bytes, start.reserved_bytes);
  EXPECT_LT(end.resident_mib, 1.02 * start.resident_mib);
}

TEST(Lifetime, NothingPilesUp) {
  run_frames(40, 120);
}

// lightwell_renderer_test --gtest_also_run_disabled_tests --gtest_filter='*ThreeThousandFrames'
TEST(Lifetime, DISABLED_NothingPilesUpInThreeThousandFrames) {
  run_frames(100, 3000);
}

}  // namespace
}  // namespace lightwell
