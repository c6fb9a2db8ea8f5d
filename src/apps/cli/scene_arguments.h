// What `lightwell` commands are told about a scene and the view of it.
#pragma once

#include <string>
#include <vector>

#include "lightwell/scene.h"

namespace CLI {
class App;
}

namespace lightwell {

struct SceneArguments {
  std::string scene;  // a file or a built-in name
  std::string scale = "1";
  std::string up = "y";
  std::string root;  // "": files may be read anywhere
  std::string default_color;
  bool no_lights = false;
  std::vector<std::string> lights;
  std::string sun;
  std::string environment;
  bool strict = false;
};

// Adds SCENE, --scale, --up, --root, --default-color, --no-lights, --light, --sun, --env and --strict.
void add_scene_options(CLI::App& command, SceneArguments& arguments);

// Loads the scene and changes its lights as told. Throws InputError, with --strict also after warnings.
Scene load_scene(const SceneArguments& arguments);

// What --strict asks for, to whoever caught the warnings of loading: throws InputError if there are any.
void refuse_warnings(const SceneArguments& arguments, const std::vector<std::string>& warnings);

struct CameraArguments {
  std::string name;
  std::string eye, target, fov;
};

// Adds --camera, --eye, --target and --fov.
void add_camera_options(CLI::App& command, CameraArguments& arguments);

// Whether the camera that was asked for is one of the scene, which its node moves.
bool is_camera_of_scene(const SceneSnapshot& snapshot, const CameraArguments& arguments);

// The camera that was asked for: by --eye and --target, else by name, else the scene's first one, else a view of the
// whole scene. Throws InputError.
WorldCamera choose_camera(const Scene& scene, const SceneSnapshot& snapshot, const CameraArguments& arguments);

}  // namespace lightwell
