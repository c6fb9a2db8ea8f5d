// lightwell info: what is in a scene, and which techniques there are.
#include <cstdio>
#include <functional>
#include <memory>

#include <CLI/CLI.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "apps/cli/commands.h"
#include "apps/cli/render_methods.h"
#include "apps/cli/scene_arguments.h"
#include "core/log.h"
#include "core/printable.h"
#include "gpu/device.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

using Json = nlohmann::ordered_json;

struct InfoArguments {
  SceneArguments scene;
  bool techniques = false;
  bool json = false;
};

Json as_json(const glm::vec3& v) {
  return {v.x, v.y, v.z};
}

Json counts_of(const Scene& scene, const SceneSnapshot& snapshot) {
  std::size_t primitives = 0, vertices = 0, triangles = 0, emissive = 0, morph_targets = 0;
  for (const Mesh& mesh : scene.meshes) {
    primitives += mesh.primitives.size();
    morph_targets += mesh.morph_weights.size();
  }
  for (const MeshInstance& instance : snapshot.instances)
    for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives) {
      vertices += primitive.positions.size();
      triangles += primitive.indices.size() / 3;
      if (primitive.material < 0) continue;
      const Material& material = scene.materials[static_cast<std::size_t>(primitive.material)];
      if (material.emission != glm::vec3(0.0f)) emissive += primitive.indices.size() / 3;
    }
  return {{"meshes", scene.meshes.size()},
          {"primitives", primitives},
          {"instances", snapshot.instances.size()},
          {"vertices", vertices},
          {"triangles", triangles},
          {"emissive_triangles", emissive},
          {"materials", scene.materials.size()},
          {"textures", scene.textures.size()},
          {"nodes", scene.nodes.size()},
          {"skins", scene.skins.size()},
          {"morph_targets", morph_targets},
          {"animations", scene.animations.size()},
          {"lights", snapshot.lights.size()},
          {"cameras", snapshot.cameras.size()}};
}

Json as_json(const WorldLight& light) {
  static constexpr const char* kNames[] = {"point", "spot", "directional"};
  Json json = {{"type", kNames[static_cast<std::size_t>(light.type)]}};
  if (light.type != LightType::kDirectional) json["position"] = as_json(light.position);
  if (light.type != LightType::kPoint) json["direction"] = as_json(light.direction);
  json[light.type == LightType::kDirectional ? "irradiance" : "intensity"] = as_json(light.intensity);
  return json;
}

Json as_json(const WorldCamera& camera) {
  return {{"name", camera.name},
          {"position", as_json(camera.position)},
          {"forward", as_json(camera.forward)},
          {"yfov_degrees", glm::degrees(camera.yfov)}};
}

Json as_json(const Animation& animation) {
  return {{"name", animation.name}, {"seconds", animation_end(animation)}, {"channels", animation.channels.size()}};
}

Json as_json(const Skin& skin) {
  return {{"joints", skin.joints.size()}};
}

// Of meshes that have morph targets.
Json as_json(const Mesh& mesh) {
  return {{"mesh", mesh.name}, {"targets", mesh.morph_weights.size()}};
}

bool is_lit(const Scene& scene, const Json& counts) {
  const bool environment = scene.environment.radiance != glm::vec3(0.0f) || scene.environment.map.width > 0;
  return environment || counts["lights"] != 0 || counts["emissive_triangles"] != 0;
}

// What there may be a million of: each item is made where it is printed.
struct List {
  const char* key;      // in JSON
  const char* heading;  // of an item in text
  std::size_t size;
  std::function<Json(std::size_t)> item;
};

struct Description {
  Json summary;
  std::vector<List> lists;
  std::vector<std::string> warnings;
};

template <typename T>
List list_of(const char* key, const char* heading, const std::vector<T>& values) {
  return {key, heading, values.size(), [&](std::size_t i) { return as_json(values[i]); }};
}

// `scene` and `snapshot` outlive the result.
Description describe(const std::string& name, const Scene& scene, const SceneSnapshot& snapshot) {
  Description description;
  Json& json = description.summary;
  json = {{"scene", name}, {"counts", counts_of(scene, snapshot)}};
  json["bounds"] = {{"minimum", as_json(snapshot.bounds.minimum)}, {"maximum", as_json(snapshot.bounds.maximum)}};
  json["environment"] = {{"radiance", as_json(scene.environment.radiance)},
                         {"map", {scene.environment.map.width, scene.environment.map.height}}};
  std::vector<std::size_t> morphed;
  for (std::size_t i = 0; i < scene.meshes.size(); ++i)
    if (!scene.meshes[i].morph_weights.empty()) morphed.push_back(i);
  description.lists = {list_of("lights", "light", snapshot.lights),
                       list_of("cameras", "camera", snapshot.cameras),
                       list_of("animations", "animation", scene.animations),
                       list_of("skins", "skin", scene.skins),
                       {"morph_targets", "morph targets", morphed.size(),
                        [&, morphed](std::size_t i) { return as_json(scene.meshes[morphed[i]]); }}};
  if (json["counts"]["triangles"] == 0) description.warnings.emplace_back("the scene has no triangles");
  if (!is_lit(scene, json["counts"])) description.warnings.emplace_back("nothing in the scene gives light");
  return description;
}

std::string plain(const Json& value) {
  if (value.is_string()) return printable(value.get<std::string>());
  if (value.is_number_float()) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value.get<double>());
    return text;
  }
  if (!value.is_array()) return value.dump();
  std::string text;
  for (const Json& element : value) text.append(text.empty() ? "" : " ").append(plain(element));
  return text;
}

void print_members(const char* heading, const Json& object) {
  std::printf("%s", heading);
  for (const auto& [key, value] : object.items()) std::printf("  %s %s", key.c_str(), plain(value).c_str());
  std::printf("\n");
}

void print_text(const Description& description) {
  const Json& json = description.summary;
  std::printf("scene  %s\n", plain(json["scene"]).c_str());
  for (const auto& [key, value] : json["counts"].items())
    std::printf("  %-18s %s\n", key.c_str(), plain(value).c_str());
  print_members("bounds", json["bounds"]);
  print_members("environment", json["environment"]);
  for (const List& list : description.lists)
    for (std::size_t i = 0; i < list.size; ++i) print_members(list.heading, list.item(i));
  for (const std::string& warning : description.warnings) std::printf("warning  %s\n", printable(warning).c_str());
}

std::string on_one_line(const Json& json) {
  return json.dump(-1, ' ', true, Json::error_handler_t::replace);  // ASCII: no terminal takes it for commands
}

void print_json(const Description& description) {
  std::printf("{\n");
  for (const auto& [key, value] : description.summary.items())
    std::printf("  \"%s\": %s,\n", key.c_str(), on_one_line(value).c_str());
  for (const List& list : description.lists) {
    std::printf("  \"%s\": [", list.key);
    for (std::size_t i = 0; i < list.size; ++i)
      std::printf("%s\n    %s", i == 0 ? "" : ",", on_one_line(list.item(i)).c_str());
    std::printf("],\n");
  }
  std::printf("  \"warnings\": %s\n}\n", on_one_line(description.warnings).c_str());
}

void print_scene(const SceneArguments& arguments, bool as_json) {
  const WarningCapture capture;
  SceneArguments to_the_end = arguments;  // what is wrong is listed before it is refused
  to_the_end.strict = false;
  Scene scene = load_scene(to_the_end);
  scene.origin = glm::dvec3(0.0);  // places are printed in the file's coordinates
  const SceneSnapshot snapshot = take_snapshot(scene);
  Description description = describe(arguments.scene, scene, snapshot);
  const std::vector<std::string> found = capture.warnings();
  description.warnings.insert(description.warnings.begin(), found.begin(), found.end());
  if (as_json)
    print_json(description);
  else
    print_text(description);
  refuse_warnings(arguments, found);
}

void print_techniques(bool as_json) {
  Json list = Json::array();
  for (const RenderMethod& method : make_render_methods()) {
    Json presets = Json::array();
    if (!as_json) std::printf("## %s\n\n%s\n", method.name.c_str(), method.help.c_str());
    for (const std::string& preset : method.presets.empty() ? std::vector<std::string>{""} : method.presets) {
      const DescribeOptions options = all_options(method, preset);
      presets.push_back({{"name", preset}, {"options", Json::parse(options_as_json(options))}});
      if (as_json) continue;
      if (!preset.empty()) std::printf("\n### --preset %s\n", preset.c_str());
      std::printf("\n%s\n", options_as_markdown(options).c_str());
    }
    list.push_back({{"name", method.name}, {"help", method.help}, {"presets", presets}});
  }
  if (as_json) std::printf("%s\n", list.dump(2).c_str());
}

// Best first, as --device numbers them.
void print_devices(bool as_json) {
  Json list = Json::array();
  for (const DeviceSummary& device : list_devices())
    list.push_back({{"name", device.name},
                    {"type", device.type},
                    {"driver", device.driver},
                    {"ray_queries", device.ray_query},
                    {"missing", device.missing}});
  if (as_json) {
    std::printf("%s\n", list.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
    return;
  }
  if (list.empty()) std::printf("no Vulkan device; the path tracer needs none\n");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Json& device = list[i];
    std::printf("device %zu  %s (%s), driver %s%s\n", i, plain(device["name"]).c_str(), plain(device["type"]).c_str(),
                plain(device["driver"]).c_str(), device["ray_queries"] == true ? ", ray queries" : "");
    for (const Json& feature : device["missing"]) std::printf("  lacks %s\n", plain(feature).c_str());
  }
}

void info(const InfoArguments& arguments) {
  if (arguments.techniques) return print_techniques(arguments.json);
  if (arguments.scene.scene.empty()) return print_devices(arguments.json);
  print_scene(arguments.scene, arguments.json);
}

}  // namespace

void add_info_command(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("info", "List the devices, load and check a scene, or list the techniques");
  const auto arguments = std::make_shared<InfoArguments>();
  add_scene_options(*command, arguments->scene);
  command->get_option("SCENE")->required(false);
  command->add_flag("--techniques", arguments->techniques, "List techniques and their options, as Markdown or JSON");
  command->add_flag("--json", arguments->json, "Print JSON");
  command->callback([arguments] { info(*arguments); });
}

}  // namespace lightwell
