// The files that a scene is made of, and which of them may be read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace lightwell {

class SceneFiles {
 public:
  // `root`: ImportOptions::root. Throws InputError if it is no folder.
  explicit SceneFiles(const std::string& root);

  // False also for names that cannot be those of a file. Both throw InputError naming the file if it lies outside the
  // root, once symbolic links are resolved.
  bool exists(const std::string& path) const;
  // Throws InputError as read_file() does: for what is missing or no regular file.
  std::vector<std::uint8_t> read(const std::string& path) const;

 private:
  std::string resolved(const std::string& path) const;

  std::filesystem::path root_;  // canonical; empty: everything may be read
};

}  // namespace lightwell
