#include "scene/scene_files.h"

#include <algorithm>
#include <system_error>

#include "core/files.h"
#include "core/log.h"
#include "scene/uri.h"

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
    throw ForbiddenFile(path,
                        "lies outside of " + root_.string() + ", the folder that a scene's files may be read from");
  return file.string();
}

bool SceneFiles::exists(const std::string& path) const {
  std::error_code ec;
  return fs::exists(resolved(path), ec);
}

std::vector<std::uint8_t> SceneFiles::read(const std::string& path) const {
  const std::string file = resolved(path);
  std::error_code ec;
  if (fs::exists(file, ec) && !fs::is_regular_file(file, ec)) throw ForbiddenFile(path, "not a regular file");
  return read_file(file);
}

std::optional<std::string> SceneFiles::find_file(const std::string& base, const std::string& name) const {
  const std::string path = resolve_name(base, name);
  const std::string last = resolve_name(base, last_part(name));
  if (path == last || last_part(name).empty()) return exists(path) ? std::optional(path) : std::nullopt;
  try {
    if (exists(path)) return path;
    if (!exists(last)) return std::nullopt;
  } catch (const ForbiddenFile&) {
    if (!exists(last)) throw;  // an absolute path, of a machine whose folders are not there
  }
  log_warning(last + ": taken for '" + name + "', which is not there, used by " + base);
  return last;
}

}  // namespace lightwell
