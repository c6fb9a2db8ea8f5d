// A glTF 2.0 file as stored: JSON, buffers, buffer views, image bytes. Nothing is interpreted here, all is checked.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/file_notes.h"
#include "scene/json_view.h"
#include "scene/memory_budget.h"
#include "scene/scene_files.h"

namespace lightwell {

using Bytes = std::span<const std::uint8_t>;

class GltfFile {
 public:
  // Reads a .gltf or .glb file (told apart by content). Throws InputError: not glTF 2, an unknown required extension.
  GltfFile(const std::string& path, const SceneFiles& files);

  const std::string& path() const { return path_; }
  const JsonDocument& document() const { return *json_; }
  JsonView root() const { return JsonView(*json_); }
  MemoryBudget& budget() { return budget_; }
  FileNotes& notes() { return notes_; }
  // A warning about `where`; of several with the same `what` the first is named.
  void note(const JsonView& where, std::string_view what, std::size_t count = 1) {
    notes_.add([&] { return where.place(); }, what, count);
  }

  // Elements of an accessor that a compressed mesh holds, packed; `reference` holds the accessor's index. Without data
  // where there are none.
  void set_accessor_bytes(const JsonView& reference, std::vector<std::uint8_t> bytes);
  Bytes accessor_bytes(const JsonView& reference) const;

  // The bytes of a buffer view, decompressed. `view` is an index that was checked.
  Bytes buffer_view(std::size_t view);
  // Its stride, 0 if elements are packed.
  std::size_t buffer_view_stride(std::size_t view) const;

  struct EncodedImage {
    std::string subject;  // names the file in errors
    Bytes bytes;
  };
  // Nothing, after a warning, if there is no such file or it cannot be read. Throws ForbiddenFile.
  std::optional<EncodedImage> image(std::size_t image);

 private:
  void parse_glb(Bytes file);
  void check_header() const;
  Bytes buffer(std::size_t index);
  Bytes part_of_buffer(const JsonView& json);
  bool has_data(const JsonView& buffer) const;
  Bytes external_file(const std::string& file_path);
  std::optional<EncodedImage> read_image(std::size_t image);

  std::string path_;
  const SceneFiles& files_;
  MemoryBudget budget_;
  FileNotes notes_;
  std::vector<std::uint8_t> file_;
  Bytes binary_chunk_;
  std::unique_ptr<JsonDocument> json_;
  std::map<std::size_t, std::vector<std::uint8_t>> accessor_bytes_;
  std::map<std::size_t, std::vector<std::uint8_t>> decompressed_views_;
  std::map<std::size_t, std::vector<std::uint8_t>> embedded_buffers_;
  std::map<std::size_t, std::vector<std::uint8_t>> embedded_images_;
  std::map<std::string, std::vector<std::uint8_t>> external_files_;
};

}  // namespace lightwell
