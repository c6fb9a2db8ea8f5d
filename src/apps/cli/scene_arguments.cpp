#include "apps/cli/scene_arguments.h"

#include <cmath>
#include <filesystem>

#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vector_relational.hpp>

#include "apps/cli/text.h"
#include "core/log.h"
#include "lightwell/error.h"
#include "scene/builtin.h"
#include "scene/light_spec.h"
#include "scene/look_at.h"

namespace lightwell {

namespace {

WorldCamera camera_at(const CameraArguments& arguments, const glm::dvec3& origin, const Bounds& bounds) {
  const glm::vec3 eye(parse_position("--eye", arguments.eye) - origin);
  const glm::vec3 target(parse_position("--target", arguments.target) - origin);
  const float distance = glm::length(target - eye);
  if (!(distance > 0.0f) || !std::isfinite(distance))
    throw InputError("--target", "is the same point as --eye, or too far from it");
  WorldCamera camera = look_at(eye, target, bounds);
  camera.name = "command line";
  return camera;
}

WorldCamera camera_by_name(const SceneSnapshot& snapshot, const std::string& name) {
  std::vector<std::string> names;
  for (const WorldCamera& camera : snapshot.cameras) {
    if (camera.name == name) return camera;
    names.push_back(camera.name);
  }
  throw InputError("--camera", "no camera '" + name + "' in the scene" +
                                   (names.empty() ? ", which has none" : " (there are: " + join(names) + ")"));
}

// Gives all primitives without a material one of their own.
void set_default_color(Scene& scene, const std::string& text) {
  const glm::vec3 color = parse_vector("--default-color", text);
  if (glm::any(glm::lessThan(color, glm::vec3(0.0f))) || glm::any(glm::greaterThan(color, glm::vec3(1.0f))))
    throw InputError("--default-color", "'" + text + "' is not in 0 to 1");
  const int added = static_cast<int>(scene.materials.size());
  Material& material = scene.materials.emplace_back();
  material.name = "command line";
  material.base_color = glm::vec4(color, 1.0f);
  for (Mesh& mesh : scene.meshes)
    for (Primitive& primitive : mesh.primitives)
      if (primitive.material < 0) primitive.material = added;
}

Scene load_with_warnings(const SceneArguments& arguments) {
  ImportOptions options;
  options.scale = parse_number("--scale", arguments.scale, 1e-6f, 1e6f);
  if (arguments.up != "y" && arguments.up != "z") throw InputError("--up", "'" + arguments.up + "' is not y or z");
  options.up = arguments.up[0];
  std::error_code ec;
  if (!arguments.root.empty() && !std::filesystem::is_directory(arguments.root, ec))
    throw InputError("--root", "'" + arguments.root + "' is no folder");
  options.root = arguments.root;
  Scene scene = load_scene(resolve_scene(arguments.scene), options);
  if (!arguments.default_color.empty()) set_default_color(scene, arguments.default_color);
  if (arguments.no_lights) remove_lights(scene);
  for (const std::string& light : arguments.lights) add_light(scene, light);
  if (!arguments.sun.empty()) add_sun(scene, arguments.sun);
  if (!arguments.environment.empty()) scene.environment = parse_environment(arguments.environment);
  return scene;
}

}  // namespace

void add_scene_options(CLI::App& command, SceneArguments& arguments) {
  command.add_option("SCENE", arguments.scene, "A .gltf, .glb, .obj or .ply file, or the name of a built-in scene")
      ->required();
  command.add_option("--scale", arguments.scale, "Unit of the file in metres, e.g. 0.01 (1)");
  command.add_option("--up", arguments.up, "Up axis of the file, y or z (y)");
  command.add_option("--root", arguments.root,
                     "Read the scene and the files that it names only below this folder (anywhere)");
  command.add_option("--default-color", arguments.default_color,
                     "Base colour r,g,b of surfaces that have no material in the file (glTF: white)");
  command.add_flag("--no-lights", arguments.no_lights, "Leave out the lights of the file");
  command
      .add_option("--light", arguments.lights,
                  "Add a light: \"point pos=x,y,z intensity=r,g,b\", \"spot pos=x,y,z dir=x,y,z intensity=r,g,b "
                  "inner=deg outer=deg\" (W/sr), \"sun dir=x,y,z irradiance=r,g,b\" (W/m^2)")
      ->allow_extra_args(false);
  command.add_option("--sun", arguments.sun, "Add a sun: \"x,y,z irradiance\", the way its light goes and W/m^2");
  command.add_option("--env", arguments.environment, "Light from outside: FILE.hdr, FILE.exr or r,g,b in W/(sr m^2)");
  command.add_flag("--strict", arguments.strict,
                   "Fail where loading warns: something of the files is left out or changed");
}

Scene load_scene(const SceneArguments& arguments) {
  if (!arguments.strict) return load_with_warnings(arguments);
  Scene scene;
  std::vector<std::string> warnings;
  {
    const WarningCapture capture;
    scene = load_with_warnings(arguments);
    warnings = capture.warnings();
  }
  for (const std::string& warning : warnings) log_warning(warning);
  refuse_warnings(arguments, warnings);
  return scene;
}

void refuse_warnings(const SceneArguments& arguments, const std::vector<std::string>& warnings) {
  if (arguments.strict && !warnings.empty())
    throw InputError("--strict", std::to_string(warnings.size()) + (warnings.size() == 1 ? " warning" : " warnings") +
                                     " in loading " + arguments.scene);
}

void add_camera_options(CLI::App& command, CameraArguments& arguments) {
  CLI::Option* name = command.add_option("--camera", arguments.name, "Camera of the scene, by name (the first one)");
  CLI::Option* eye = command.add_option("--eye", arguments.eye, "Camera position x,y,z in metres, instead of --camera");
  CLI::Option* target = command.add_option("--target", arguments.target, "The point x,y,z that the camera looks at");
  eye->needs(target)->excludes(name);
  target->needs(eye);
  command.add_option("--fov", arguments.fov, "Vertical field of view in degrees (the camera's own, or 45)");
}

bool is_camera_of_scene(const SceneSnapshot& snapshot, const CameraArguments& arguments) {
  return arguments.eye.empty() && !(arguments.name.empty() && snapshot.cameras.empty());
}

WorldCamera choose_camera(const Scene& scene, const SceneSnapshot& snapshot, const CameraArguments& arguments) {
  WorldCamera camera;
  if (!arguments.eye.empty())
    camera = camera_at(arguments, scene.origin, snapshot.bounds);
  else if (!arguments.name.empty())
    camera = camera_by_name(snapshot, arguments.name);
  else
    camera = snapshot.cameras.empty() ? default_camera(snapshot.bounds) : snapshot.cameras.front();
  if (!arguments.fov.empty()) camera.yfov = glm::radians(parse_number("--fov", arguments.fov, 1.0f, 170.0f));
  return camera;
}

}  // namespace lightwell
