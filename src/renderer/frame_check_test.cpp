// What record(), render() and the constructor say of a host's mistakes.
#include "renderer/frame_check.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "lightwell/error.h"
#include "lightwell/metrics.h"
#include "renderer/testing/host.h"

namespace lightwell {
namespace {

class HostMistakes : public ::testing::Test {
 protected:
  void SetUp() override {
    if (list_devices().empty()) GTEST_SKIP() << "no Vulkan device on this machine";
    ASSERT_TRUE(host_.works());
    device_ = wrap_device(host_.lend());
    test_ = make_scene();
    snapshot_ = take_snapshot(test_.scene);
    snapshot_.lights.push_back(point_light({0.3f, 0.2f, 1}, glm::vec3(5)));
    snapshot_.instances[1].joints.resize(2, glm::mat4(1.0f));
    renderer_ = std::make_unique<Renderer>(*device_, test_.scene, snapshot_, square_picture(kSide), kFramesInFlight);
    frame_ = std::make_unique<HostFrame>(host_);
    target_ = {frame_->image, VK_FORMAT_B8G8R8A8_UNORM, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
               0.5f};
  }

  // Whatever a host did wrong, the next frame is as if it had not been.
  void TearDown() override {
    if (!renderer_) return;
    frame_->begin();
    EXPECT_EQ(renderer_->record(frame_->commands, {&snapshot_, camera_}, target_, 0).frame, 1u);
    frame_->end();
    frame_->wait();
    expect_same_picture(*frame_, tone_map(renderer_->render({&snapshot_, camera_}).combined, 0.5f));
    renderer_.reset();
    device_.reset();
    frame_.reset();
    for (const std::string& message : host_.messages()) ADD_FAILURE() << message;
  }

  std::string mistake(const FrameView& view) { return mistake(view, target_, 0); }
  std::string mistake(const FrameView& view, const RenderTarget& target, std::uint64_t completed) {
    try {
      renderer_->record(frame_->commands, view, target, completed);
    } catch (const InputError& e) {
      return e.what();
    }
    return "none";
  }
  template <class Change>
  std::string with_snapshot(const Change& change) {
    SceneSnapshot changed = snapshot_;
    change(changed);
    return mistake({&changed, camera_});
  }
  template <class Change>
  std::string with_camera(const Change& change) {
    WorldCamera changed = camera_;
    change(changed);
    return mistake({&snapshot_, changed});
  }
  template <class Change>
  std::string with_target(const Change& change) {
    RenderTarget changed = target_;
    change(changed);
    return mistake({&snapshot_, camera_}, changed, 0);
  }

  Host host_;
  DevicePtr device_;
  TestScene test_;
  SceneSnapshot snapshot_;
  WorldCamera camera_ = camera_before_wall(2, 2);
  std::unique_ptr<Renderer> renderer_;
  std::unique_ptr<HostFrame> frame_;
  RenderTarget target_;
};

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST_F(HostMistakes, AnotherScenesSnapshot) {
  EXPECT_EQ(mistake({nullptr, camera_}), "FrameView::snapshot: is null");
  EXPECT_EQ(with_snapshot([](SceneSnapshot& s) { s.instances.pop_back(); }),
            "FrameView::snapshot: 1 instances, the renderer was made with 2");
  EXPECT_EQ(with_snapshot([](SceneSnapshot& s) { s.instances.push_back(s.instances[0]); }),
            "FrameView::snapshot: 3 instances, the renderer was made with 2");
  EXPECT_EQ(with_snapshot([](SceneSnapshot& s) { s.instances[0].mesh = 1; }),
            "FrameView::snapshot: instances[0] shows mesh 1, the renderer was made with mesh 0");
  EXPECT_EQ(with_snapshot([](SceneSnapshot& s) { s.instances[1].joints.pop_back(); }),
            "FrameView::snapshot: instances[1] has 1 joints, the renderer was made with 2");
  SceneSnapshot none;
  EXPECT_THROW(renderer_->render({&none, camera_}), InputError);
}

TEST_F(HostMistakes, NumbersThatAreNone) {
  EXPECT_NE(with_snapshot([](SceneSnapshot& s) { s.instances[1].to_world[3].x = kNan; }).find("instance 1"),
            std::string::npos);
  EXPECT_NE(with_snapshot([](SceneSnapshot& s) { s.instances[1].joints[0][0].x = kNan; }).find("instance 1"),
            std::string::npos);
  EXPECT_NE(with_snapshot([](SceneSnapshot& s) { s.lights[0].position.y = kNan; }).find("light 0"), std::string::npos);
  EXPECT_EQ(with_snapshot([](SceneSnapshot& s) { s.lights[0].intensity.y = kNan; }),
            "FrameView::snapshot: lights[0].intensity is not in 0 to 1e18");
  EXPECT_EQ(with_snapshot([](SceneSnapshot& s) { s.lights[0].direction = glm::vec3(0.0f); }),
            "FrameView::snapshot: lights[0].direction is no direction");
  EXPECT_EQ(with_camera([](WorldCamera& c) { c.position.z = kNan; }),
            "FrameView::camera: position is farther than 1e9 metres or not finite");
  EXPECT_EQ(with_camera([](WorldCamera& c) { c.up = c.forward; }),
            "FrameView::camera: forward and up are not finite or parallel");
  EXPECT_EQ(with_camera([](WorldCamera& c) { c.yfov = kNan; }), "FrameView::camera: yfov is not between 0 and pi");
  FrameView view{&snapshot_, camera_};
  view.points_of_interest = {glm::vec3(0.0f), glm::vec3(0.0f, 2e9f, 0.0f)};
  EXPECT_EQ(mistake(view), "FrameView: points_of_interest[1] is farther than 1e9 metres or not finite");
}

TEST_F(HostMistakes, ATargetThatCannotBeDrawnTo) {
  EXPECT_EQ(with_target([](RenderTarget& t) { t.image = VK_NULL_HANDLE; }), "RenderTarget::image: is VK_NULL_HANDLE");
  EXPECT_EQ(with_target([](RenderTarget& t) { t.format = VK_FORMAT_D32_SFLOAT; }),
            "RenderTarget::format: 126 cannot be drawn to on this device");
  EXPECT_EQ(with_target([](RenderTarget& t) { t.layout_after = VK_IMAGE_LAYOUT_UNDEFINED; }),
            "RenderTarget::layout_after: is no layout to bring an image to");
  EXPECT_EQ(with_target([](RenderTarget& t) { t.exposure = kNan; }),
            "RenderTarget::exposure: is negative or not finite");
  EXPECT_THROW(renderer_->record(VK_NULL_HANDLE, {&snapshot_, camera_}, target_, 0), InputError);
  EXPECT_EQ(mistake({&snapshot_, camera_}, target_, 1), "completed: frame 1 was not recorded yet; the last one was 0");
}

TEST(HostMistake, TooManyFramesInFlight) {
  if (list_devices().empty()) GTEST_SKIP() << "no Vulkan device on this machine";
  Host host;
  ASSERT_TRUE(host.works());
  const TestScene test = make_scene();
  const SceneSnapshot snapshot = take_snapshot(test.scene);
  const DevicePtr device = wrap_device(host.lend());
  std::vector<std::unique_ptr<HostFrame>> frames;
  for (int i = 0; i < 3; ++i) frames.push_back(std::make_unique<HostFrame>(host));
  Renderer renderer(*device, test.scene, snapshot, square_picture(kSide), 2);
  const auto record = [&](std::size_t i, std::uint64_t completed) {
    frames[i]->begin();
    const RenderTarget target{frames[i]->image, VK_FORMAT_B8G8R8A8_UNORM, VK_IMAGE_LAYOUT_UNDEFINED,
                              VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
    renderer.record(frames[i]->commands, {&snapshot, camera_before_wall(2, 2)}, target, completed);
  };
  record(0, 0);
  record(1, 0);
  try {
    record(2, 0);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "completed: frames after 0 up to 2 are unfinished; the renderer was made for 2 in flight");
  }
}

TEST(HostMistake, ARendererOfAnotherScene) {
  if (list_devices().empty()) GTEST_SKIP() << "no Vulkan device on this machine";
  Device device;
  TestScene test = make_scene();
  const auto refusal = [&](const SceneSnapshot& snapshot) -> std::string {
    try {
      Renderer(device, test.scene, snapshot, square_picture(kSide));
    } catch (const InputError& e) {
      return e.what();
    }
    return "none";
  };
  SceneSnapshot snapshot = take_snapshot(test.scene);
  snapshot.instances[0].mesh = 2;
  EXPECT_EQ(refusal(snapshot), "SceneSnapshot: instances[0].mesh 2 is none of the scene's 2");
  Primitive& skinned = test.scene.meshes[1].primitives[0];
  skinned.joints.assign(4, {0, 3, 0, 0});
  skinned.weights.assign(4, {0.5f, 0.5f, 0, 0});
  snapshot = take_snapshot(test.scene);
  snapshot.instances[1].joints.resize(3, glm::mat4(1.0f));
  EXPECT_EQ(refusal(snapshot), "SceneSnapshot: instances[1] has 3 joints, its mesh uses 4");
}

}  // namespace
}  // namespace lightwell
