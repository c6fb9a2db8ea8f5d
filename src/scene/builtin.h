// Scenes that come with the program, by name.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace lightwell {

// Names of all built-in scenes, sorted. They are the .gltf and .glb files in $LIGHTWELL_SCENES, in the source tree's
// scenes/, and in ../share/lightwell/scenes beside the program; the first of these that has a name wins.
std::vector<std::string> builtin_scene_names();

// The file of a built-in scene; nothing if there is none of that name.
std::optional<std::string> builtin_scene_path(const std::string& name);

// What SCENE on the command line means: a file that exists, or else a built-in scene. Throws InputError that lists the
// built-in names.
std::string resolve_scene(const std::string& file_or_name);

}  // namespace lightwell
