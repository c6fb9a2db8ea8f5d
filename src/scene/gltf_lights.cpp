// Lights and cameras.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <glm/common.hpp>

#include "scene/gltf_parts.h"
#include "scene/gltf_repair.h"

namespace lightwell {

namespace {

constexpr float kHalfPi = 1.57079637f;
constexpr float kLargest = std::numeric_limits<float>::max();
// A camera without a far plane sees this many times as far as its near plane.
constexpr float kInfiniteFarPlane = 1e5f;
constexpr float kDefaultNearPlane = 0.01f;  // m
constexpr float kDefaultFieldOfView = 0.7853982f;

// A cone whose inner angle reaches its outer one has a hard edge: the outer angle becomes a hair larger.
void read_cone(GltfFile& file, const JsonView& json, Light& light) {
  constexpr float kHair = 1e-3f;
  light.inner_angle = read_number(file, json["innerConeAngle"], light.inner_angle, 0.0f, kHalfPi);
  light.outer_angle = read_number(file, json["outerConeAngle"], light.outer_angle, 0.0f, kHalfPi);
  if (light.inner_angle < light.outer_angle) return;
  file.note(json, "the inner cone angle is not below the outer one: taken as a hard edge");
  light.outer_angle = std::min(light.inner_angle + kHair, kHalfPi);
  light.inner_angle = std::min(light.inner_angle, light.outer_angle - kHair);
}

Light read_light(GltfFile& file, const JsonView& json, LightType type) {
  Light light;
  light.type = type;
  light.name = read_name(file, json["name"]);
  glm::vec3 color(1.0f);
  read_color(file, json["color"], {&color.x, 3}, kLargest);
  const float intensity = read_number(file, json["intensity"], 1.0f, 0.0f, kLargest);
  light.intensity = glm::min(color * intensity, glm::vec3(kMaxLight));
  if (type == LightType::kSpot) read_cone(file, json["spot"], light);
  if (json["range"].present()) {
    const float range = read_number(file, json["range"], light.range, -kLargest, kLargest);
    if (range > 0.0f)
      light.range = range;
    else
      file.note(json["range"], "is not more than 0: the light has none");
  }
  return light;
}

Camera read_perspective(GltfFile& file, const JsonView& json) {
  Camera camera;
  camera.yfov = read_number(file, json["yfov"], camera.yfov, -kLargest, kLargest);
  if (!(camera.yfov > 1e-4f && camera.yfov < 3.1415f)) {
    file.note(json["yfov"], "is no field of view: taken as 45 degrees");
    camera.yfov = kDefaultFieldOfView;
  }
  camera.znear = read_number(file, json["znear"], kDefaultNearPlane, 0.0f, kMaxCoordinate);
  if (!(camera.znear > 0.0f)) {
    file.note(json["znear"], "is zero: taken as 0.01");
    camera.znear = kDefaultNearPlane;
  }
  camera.zfar = read_number(file, json["zfar"], camera.znear * kInfiniteFarPlane, 0.0f, kLargest);
  return camera;
}

Camera read_orthographic(GltfFile& file, const JsonView& json) {
  Camera camera;
  const float half_height = std::abs(read_number(file, json["ymag"], 1.0f, -kMaxCoordinate, kMaxCoordinate));
  camera.half_height = half_height > 0.0f ? half_height : 1.0f;
  if (half_height == 0.0f) file.note(json["ymag"], "is zero: taken as 1");
  camera.znear = read_number(file, json["znear"], 0.0f, 0.0f, kMaxCoordinate);
  camera.zfar = read_number(file, json["zfar"], kMaxCoordinate, 0.0f, kLargest);
  return camera;
}

}  // namespace

std::vector<int> read_gltf_cameras(GltfFile& file, Scene& scene) {
  const JsonView cameras = file.root()["cameras"];
  std::vector<int> indices;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const JsonView json = cameras[i];
    const std::string type = json["type"].string("perspective");
    if (type != "perspective" && type != "orthographic") {
      file.note(json["type"], "is no kind of camera that is known: left out");
      indices.push_back(-1);
      continue;
    }
    Camera camera = type == "perspective" ? read_perspective(file, json["perspective"])
                                          : read_orthographic(file, json["orthographic"]);
    if (!(camera.zfar > camera.znear)) {
      file.note(json[type.c_str()]["zfar"], "is no farther than znear: taken as far away");
      camera.zfar = std::max(camera.znear * kInfiniteFarPlane, kMaxCoordinate);
    }
    camera.name = read_name(file, json["name"]);
    indices.push_back(static_cast<int>(scene.cameras.size()));
    scene.cameras.push_back(std::move(camera));
  }
  return indices;
}

std::vector<int> read_gltf_lights(GltfFile& file, Scene& scene) {
  const JsonView lights = file.root()["extensions"]["KHR_lights_punctual"]["lights"];
  std::vector<int> indices;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const std::string type = lights[i]["type"].string("");
    int index = static_cast<int>(scene.lights.size());
    if (type == "point")
      scene.lights.push_back(read_light(file, lights[i], LightType::kPoint));
    else if (type == "directional")
      scene.lights.push_back(read_light(file, lights[i], LightType::kDirectional));
    else if (type == "spot")
      scene.lights.push_back(read_light(file, lights[i], LightType::kSpot));
    else
      index = -1;
    if (index < 0) file.note(lights[i]["type"], "is no kind of light that is known: left out");
    indices.push_back(index);
  }
  return indices;
}

}  // namespace lightwell
