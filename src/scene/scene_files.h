// The files that a scene is made of, and which of them may be read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lightwell/error.h"

namespace lightwell {

// A reference to what must not be read: it lies outside of the root, or is no regular file.
class ForbiddenFile : public InputError {
 public:
  using InputError::InputError;
};

class SceneFiles {
 public:
  // `root`: ImportOptions::root. Throws InputError if it is no folder.
  explicit SceneFiles(const std::string& root);

  // False also for names that cannot be those of a file. All throw ForbiddenFile naming the file if it lies outside the
  // root, once symbolic links are resolved.
  bool exists(const std::string& path) const;
  // Throws ForbiddenFile, and InputError as read_file() does.
  std::vector<std::uint8_t> read(const std::string& path) const;

  // Where a file is that the file `base` names, with either slash; nothing if it is nowhere. Paths of other machines
  // and addresses of the web are looked for by their last part beside `base`, with a warning where that is found.
  // Throws InputError for names that hold a zero byte.
  std::optional<std::string> find_file(const std::string& base, const std::string& name) const;

 private:
  std::string resolved(const std::string& path) const;

  std::filesystem::path root_;  // canonical; empty: everything may be read
};

}  // namespace lightwell
