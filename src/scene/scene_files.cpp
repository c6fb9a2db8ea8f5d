#include "scene/scene_files.h"

#include <algorithm>
#include <system_error>

#include "core/files.h"
#include "lightwell/error.h"

namespace lightwell {

namespace fs = std::filesystem;

SceneFiles::SceneFiles(const std::string& root) {
  if (root.empty()) return;
  std::error_code ec;
  root_ = fs::canonical(root, ec);
  if (ec || !fs::is_directory(root_, ec)) throw InputError("ImportOptions::root", "'" + root + "' is no folder");
}

// What is checked is what is opened: a path without symbolic links.
std::string SceneFiles::resolved(const std::string& path) const {
  if (root_.empty()) return path;
  std::error_code ec;
  const fs::path file = fs::weakly_canonical(path, ec);
  if (ec) throw InputError(path, ec.message());
  if (std::mismatch(root_.begin(), root_.end(), file.begin(), file.end()).first != root_.end())
    throw InputError(path, "lies outside of " + root_.string() + ", the folder that a scene's files may be read from");
  return file.string();
}

bool SceneFiles::exists(const std::string& path) const {
  std::error_code ec;
  return fs::exists(resolved(path), ec);
}

std::vector<std::uint8_t> SceneFiles::read(const std::string& path) const {
  return read_file(resolved(path));
}

}  // namespace lightwell
