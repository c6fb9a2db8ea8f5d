#include "renderer/frame_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <glm/geometric.hpp>

#include "gpu/device.h"
#include "lightwell/error.h"

namespace lightwell {
namespace {

const std::string kSnapshot = "FrameView::snapshot";

void require(bool condition, const std::string& field, const std::string& cause) {
  if (!condition) throw InputError(field, cause);
}

bool is_finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool is_light(float value) {
  return value >= 0.0f && value <= kMaxLight;  // NaN is not
}

std::string element(const char* array, std::size_t i) {
  return std::string(array) + "[" + std::to_string(i) + "]";
}

// Joints that a mesh's vertices ask for: the largest index and one; 0 without a skin.
std::size_t count_joints(const Mesh& mesh) {
  std::size_t count = 0;
  for (const Primitive& primitive : mesh.primitives)
    for (const glm::u16vec4& joints : primitive.joints)
      count = std::max(count, std::size_t{1} + std::max({joints.x, joints.y, joints.z, joints.w}));
  return count;
}

bool is_within_reach(const glm::vec3& position) {
  const glm::vec3 distance = glm::abs(position);
  return is_finite(position) && std::max({distance.x, distance.y, distance.z}) <= kMaxCoordinate;
}

void check_lights(const std::vector<WorldLight>& lights) {
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const WorldLight& light = lights[i];
    const std::string where = element("lights", i);
    require(is_light(light.intensity.x) && is_light(light.intensity.y) && is_light(light.intensity.z), kSnapshot,
            where + ".intensity is not in 0 to 1e18");
    require(is_finite(light.direction) && light.direction != glm::vec3(0.0f), kSnapshot,
            where + ".direction is no direction");
    require(std::isfinite(light.cos_inner) && std::isfinite(light.cos_outer), kSnapshot,
            where + ": its cone is not finite");
    require(light.range > 0.0f, kSnapshot, where + ".range is not more than 0");
  }
}

void check_camera(const WorldCamera& camera) {
  const std::string field = "FrameView::camera";
  require(is_within_reach(camera.position), field, "position is farther than 1e9 metres or not finite");
  const glm::vec3 side = glm::cross(camera.forward, camera.up);
  require(is_finite(side) && glm::length(side) > 1e-6f, field, "forward and up are not finite or parallel");
  const bool perspective = camera.half_height == 0.0f;
  require(!perspective || (camera.yfov > 0.0f && camera.yfov < std::numbers::pi_v<float>), field,
          "yfov is not between 0 and pi");
  require(perspective || (camera.half_height > 0.0f && camera.half_height <= kMaxCoordinate), field,
          "half_height is not in 0 to 1e9 metres");
  require(std::isfinite(camera.znear), field, "znear is not finite");
}

}  // namespace

FrameCheck::FrameCheck(const Scene& scene, const SceneSnapshot& snapshot) {
  std::vector<std::size_t> joints_of_mesh;
  for (const Mesh& mesh : scene.meshes) joints_of_mesh.push_back(count_joints(mesh));
  for (std::size_t i = 0; i < snapshot.instances.size(); ++i) {
    const MeshInstance& instance = snapshot.instances[i];
    const std::string where = element("instances", i);
    require(instance.mesh >= 0 && static_cast<std::size_t>(instance.mesh) < scene.meshes.size(), "SceneSnapshot",
            where + ".mesh " + std::to_string(instance.mesh) + " is none of the scene's " +
                std::to_string(scene.meshes.size()));
    const std::size_t used = joints_of_mesh[static_cast<std::size_t>(instance.mesh)];
    require(
        instance.joints.empty() || instance.joints.size() >= used, "SceneSnapshot",
        where + " has " + std::to_string(instance.joints.size()) + " joints, its mesh uses " + std::to_string(used));
    shapes_.push_back({instance.mesh, instance.joints.size()});
  }
}

void FrameCheck::check(const FrameView& view) const {
  require(view.snapshot != nullptr, kSnapshot, "is null");
  const std::vector<MeshInstance>& instances = view.snapshot->instances;
  require(
      instances.size() == shapes_.size(), kSnapshot,
      std::to_string(instances.size()) + " instances, the renderer was made with " + std::to_string(shapes_.size()));
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const std::string where = element("instances", i);
    require(instances[i].mesh == shapes_[i].mesh, kSnapshot,
            where + " shows mesh " + std::to_string(instances[i].mesh) + ", the renderer was made with mesh " +
                std::to_string(shapes_[i].mesh));
    require(instances[i].joints.size() == shapes_[i].joint_count, kSnapshot,
            where + " has " + std::to_string(instances[i].joints.size()) + " joints, the renderer was made with " +
                std::to_string(shapes_[i].joint_count));
  }
  validate(*view.snapshot, kSnapshot);
  check_lights(view.snapshot->lights);
  check_camera(view.camera);
  for (std::size_t i = 0; i < view.points_of_interest.size(); ++i)
    require(is_within_reach(view.points_of_interest[i]), "FrameView",
            element("points_of_interest", i) + " is farther than 1e9 metres or not finite");
}

void check_target(const Device& device, const RenderTarget& target) {
  require(target.image != VK_NULL_HANDLE, "RenderTarget::image", "is VK_NULL_HANDLE");
  require(
      target.format != VK_FORMAT_UNDEFINED && (device.usages(target.format) & VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT) != 0,
      "RenderTarget::format", std::to_string(target.format) + " cannot be drawn to on this device");
  require(target.layout_after != VK_IMAGE_LAYOUT_UNDEFINED && target.layout_after != VK_IMAGE_LAYOUT_PREINITIALIZED,
          "RenderTarget::layout_after", "is no layout to bring an image to");
  require(std::isfinite(target.exposure) && target.exposure >= 0.0f, "RenderTarget::exposure",
          "is negative or not finite");
}

void check_completed(std::uint64_t completed, std::uint64_t recorded, std::uint32_t frames_in_flight) {
  require(completed <= recorded, "completed",
          "frame " + std::to_string(completed) + " was not recorded yet; the last one was " + std::to_string(recorded));
  require(recorded - completed < frames_in_flight, "completed",
          "frames after " + std::to_string(completed) + " up to " + std::to_string(recorded) +
              " are unfinished; the renderer was made for " + std::to_string(frames_in_flight) + " in flight");
}

}  // namespace lightwell
