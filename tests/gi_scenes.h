// Test scenes with the lights and cameras of tests/lights (README.md there).
#pragma once

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "lightwell/scene.h"
#include "scene/builtin.h"
#include "scene/light_spec.h"
#include "scene/look_at.h"

namespace lightwell {

struct GiScene {
  Scene scene;          // with its lights
  SceneSnapshot world;  // at its time
  float exposure = 1.0f;
  std::map<std::string, WorldCamera> cameras;
};

inline std::vector<std::string> gi_scene_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(LIGHTWELL_LIGHTS_DIR))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

// An option's words, more than one where it is given again. None where it is not given.
inline std::vector<std::string> gi_option(const nlohmann::json& options, const char* name) {
  if (!options.contains(name)) return {};
  const nlohmann::json& value = options.at(name);
  return value.is_array() ? value.get<std::vector<std::string>>() : std::vector{value.get<std::string>()};
}

inline glm::vec3 gi_vector(const std::string& text) {
  glm::vec3 v;
  if (std::sscanf(text.c_str(), "%f,%f,%f", &v.x, &v.y, &v.z) != 3) throw std::runtime_error(text + " is not x,y,z");
  return v;
}

inline WorldCamera gi_camera(const SceneSnapshot& world, const nlohmann::json& options) {
  WorldCamera camera = world.cameras.at(0);
  for (const std::string& name : gi_option(options, "camera"))
    for (const WorldCamera& candidate : world.cameras)
      if (candidate.name == name) camera = candidate;
  for (const std::string& eye : gi_option(options, "eye"))
    camera = look_at(gi_vector(eye), gi_vector(options.at("target")), world.bounds);
  for (const std::string& fov : gi_option(options, "fov")) camera.yfov = glm::radians(std::stof(fov));
  return camera;
}

// Nothing where the scene's file is not here. Throws std::exception where the description is not as README.md has it.
inline std::optional<GiScene> load_gi_scene(const std::string& name) {
  std::ifstream file(std::string(LIGHTWELL_LIGHTS_DIR) + "/" + name + ".json");
  const nlohmann::json description = nlohmann::json::parse(file);
  const std::string path = description.contains("scene")
                               ? resolve_scene(description.at("scene"))
                               : LIGHTWELL_SHARED_DIR "/scenes/" + description.at("file").get<std::string>();
  if (!std::filesystem::exists(path)) return std::nullopt;
  const nlohmann::json& options = description.at("options");
  for (const auto& option : options.items())
    if (option.key() != "scale" && option.key() != "time" && option.key() != "light" && option.key() != "sun" &&
        option.key() != "env")
      throw std::runtime_error(name + ": option " + option.key());
  ImportOptions import;
  for (const std::string& scale : gi_option(options, "scale")) import.scale = std::stof(scale);
  GiScene result;
  result.exposure = description.at("exposure");
  result.scene = load_scene(path, import);
  for (const std::string& light : gi_option(options, "light")) add_light(result.scene, light);
  for (const std::string& sun : gi_option(options, "sun")) add_sun(result.scene, sun);
  for (const std::string& env : gi_option(options, "env")) result.scene.environment = parse_environment(env);
  result.world = take_snapshot(result.scene);
  for (const std::string& time : gi_option(options, "time"))
    result.world =
        take_snapshot(result.scene, animate_nodes(result.scene, result.scene.animations.at(0), std::stof(time)));
  for (const auto& camera : description.at("cameras").items())
    result.cameras[camera.key()] = gi_camera(result.world, camera.value());
  return result;
}

}  // namespace lightwell
