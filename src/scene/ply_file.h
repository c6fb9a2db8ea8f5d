// A PLY file as stored: its header, and its body number by number.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene_files.h"

namespace lightwell {

enum class PlyScalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

struct PlyProperty {
  std::string name;
  bool is_list = false;
  PlyScalar count_type = PlyScalar::kUint8;
  PlyScalar type = PlyScalar::kFloat;
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

class PlyFile {
 public:
  // Reads the header. Throws InputError as all members do.
  PlyFile(const std::string& path, const SceneFiles& files);

  const std::vector<PlyElement>& elements() const { return elements_; }
  const std::vector<std::string>& texture_files() const { return texture_files_; }  // "comment TextureFile NAME"

  // Before memory is taken for an element: throws if the rest of the file is too short for it.
  void check_count(const PlyElement& element) const;
  // The next number; not finite where the text is no number.
  double scalar(PlyScalar type);
  // How many numbers of a property come next: the length of its list, else 1.
  std::uint64_t take_size(const PlyProperty& property);
  void skip(const PlyElement& element);

  [[noreturn]] void fail(const std::string& cause) const { throw InputError(path_, cause); }

 private:
  void read_header();
  void header_line(std::string_view line);
  void comment(std::string_view text);
  PlyScalar parse_type(std::string_view name) const;
  template <typename T>
  double binary_scalar();

  std::string path_;
  std::vector<std::uint8_t> bytes_;
  std::string_view body_;  // what has not been read yet
  bool ascii_ = true;
  bool swap_ = false;  // byte order differs from this machine's
  std::vector<PlyElement> elements_;
  std::vector<std::string> texture_files_;
};

}  // namespace lightwell
