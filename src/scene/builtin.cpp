#include "scene/builtin.h"

#include <cstdlib>
#include <filesystem>
#include <map>
#include <system_error>

#include "lightwell/error.h"

namespace lightwell {

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> scene_folders() {
  std::vector<fs::path> folders;
  if (const char* given = std::getenv("LIGHTWELL_SCENES")) folders.emplace_back(given);
  folders.emplace_back(LIGHTWELL_BUILTIN_SCENES);
  std::error_code ec;
  const fs::path program = fs::read_symlink("/proc/self/exe", ec);
  if (!ec) folders.push_back(program.parent_path().parent_path() / "share/lightwell/scenes");
  return folders;
}

std::map<std::string, std::string> find_scenes() {
  std::map<std::string, std::string> scenes;
  for (const fs::path& folder : scene_folders()) {
    std::error_code ec;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ec)) {
      const fs::path& file = entry.path();
      if (file.extension() == ".gltf" || file.extension() == ".glb")
        scenes.emplace(file.stem().string(), file.string());
    }
  }
  return scenes;
}

}  // namespace

std::vector<std::string> builtin_scene_names() {
  std::vector<std::string> names;
  for (const auto& [name, path] : find_scenes()) names.push_back(name);
  return names;
}

std::optional<std::string> builtin_scene_path(const std::string& name) {
  const std::map<std::string, std::string> scenes = find_scenes();
  const auto found = scenes.find(name);
  if (found == scenes.end()) return std::nullopt;
  return found->second;
}

std::string resolve_scene(const std::string& file_or_name) {
  std::error_code ec;
  if (fs::exists(file_or_name, ec) && !fs::is_directory(file_or_name, ec)) return file_or_name;
  if (const std::optional<std::string> path = builtin_scene_path(file_or_name)) return *path;
  std::string names;
  for (const std::string& name : builtin_scene_names()) names += (names.empty() ? "" : ", ") + name;
  throw InputError(file_or_name, "no such file, and no built-in scene of that name (there are: " + names + ")");
}

}  // namespace lightwell
