#include "scene/gltf_file.h"

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "core/log.h"
#include "lightwell/error.h"
#include "scene/gltf_compressed.h"
#include "scene/gltf_properties.h"
#include "scene/uri.h"

namespace lightwell {

namespace {

constexpr std::uint32_t kChunkJson = 0x4e4f534a;
constexpr std::uint32_t kChunkBinary = 0x004e4942;
constexpr std::uint64_t kMaxJsonBytes = std::uint64_t{256} << 20;

std::uint32_t little_endian_u32(Bytes bytes, std::size_t at) {
  return static_cast<std::uint32_t>(bytes[at]) | static_cast<std::uint32_t>(bytes[at + 1]) << 8 |
         static_cast<std::uint32_t>(bytes[at + 2]) << 16 | static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

}  // namespace

GltfFile::GltfFile(const std::string& path, const SceneFiles& files)
    : path_(path), files_(files), budget_(path, "geometry", kGeometryLimit), notes_(path), file_(files.read(path)) {
  budget_.add_input(file_.size());
  if (file_.size() >= 4 && std::memcmp(file_.data(), "glTF", 4) == 0) {
    parse_glb(file_);
  } else {
    if (file_.size() > kMaxJsonBytes) throw InputError(path, "JSON of more than 256 MiB");
    json_ = std::make_unique<JsonDocument>(path, file_);
    file_ = std::vector<std::uint8_t>();  // the document has it all
  }
  check_header();
}

void GltfFile::parse_glb(Bytes file) {
  if (file.size() < 12) throw InputError(path_, "truncated GLB header");
  if (little_endian_u32(file, 4) != 2) throw InputError(path_, "GLB version is not 2");
  const std::size_t length = little_endian_u32(file, 8);
  if (length > file.size()) throw InputError(path_, "truncated: the GLB header promises more bytes");
  std::size_t at = 12;
  while (at + 8 <= length) {
    const std::size_t chunk_length = little_endian_u32(file, at);
    const std::uint32_t type = little_endian_u32(file, at + 4);
    at += 8;
    if (chunk_length > length - at) throw InputError(path_, "truncated GLB chunk");
    const Bytes chunk = file.subspan(at, chunk_length);
    if (type == kChunkJson && !json_) {
      if (chunk.size() > kMaxJsonBytes) throw InputError(path_, "JSON of more than 256 MiB");
      json_ = std::make_unique<JsonDocument>(path_, chunk);
    } else if (type == kChunkBinary && binary_chunk_.empty()) {
      binary_chunk_ = chunk;
    }
    at += std::min((chunk_length + 3) / 4 * 4, length - at);
  }
  if (!json_) throw InputError(path_, "GLB without a JSON chunk");
}

void GltfFile::check_header() const {
  const JsonView asset = root()["asset"];
  const std::string version = asset["version"].string("");
  if (!version.starts_with("2.")) throw InputError(path_, "glTF version is '" + version.substr(0, 20) + "', not 2.x");
  if (asset["minVersion"].string("2.0") != "2.0") throw InputError(path_, "needs a newer glTF version than 2.0");
  const JsonView required = root()["extensionsRequired"];
  for (std::size_t i = 0; i < required.size(); ++i) {
    const std::string name = required[i].string("");
    if (!can_show_without_loss_of_data(name))
      throw InputError(path_, "needs the glTF extension " + name.substr(0, 80) + ", which is not supported");
  }
}

Bytes GltfFile::external_file(const std::string& file_path) {
  const std::string key = std::filesystem::path(file_path).lexically_normal().string();
  const auto found = external_files_.find(key);
  if (found != external_files_.end()) return found->second;
  std::vector<std::uint8_t> bytes = files_.read(file_path);
  budget_.add_input(bytes.size());
  return external_files_.emplace(key, std::move(bytes)).first->second;
}

Bytes GltfFile::buffer(std::size_t index) {
  const JsonView json = root()["buffers"][index];
  Bytes bytes;
  if (!json["uri"].present()) {
    if (index != 0 || binary_chunk_.data() == nullptr) json.fail("has no data");
    bytes = binary_chunk_;
  } else if (embedded_buffers_.contains(index)) {
    bytes = embedded_buffers_[index];
  } else {
    const std::string uri = json["uri"].string("");
    if (auto embedded = decode_data_uri(path_, uri))
      bytes = embedded_buffers_.emplace(index, std::move(*embedded)).first->second;
    else
      bytes = external_file(resolve_uri(path_, uri));
  }
  const std::uint64_t length = json["byteLength"].count(0);
  if (length > bytes.size())
    json.fail("promises " + std::to_string(length) + " bytes, its data holds " + std::to_string(bytes.size()));
  return bytes.first(length);
}

void GltfFile::set_accessor_bytes(const JsonView& reference, std::vector<std::uint8_t> bytes) {
  budget_.charge(bytes.size(), 1);
  accessor_bytes_[reference.count(0)] = std::move(bytes);
}

Bytes GltfFile::accessor_bytes(const JsonView& reference) const {
  const auto found = accessor_bytes_.find(reference.count(0));
  return found == accessor_bytes_.end() ? Bytes{} : Bytes{found->second};
}

// The bytes that "buffer", "byteOffset" and "byteLength" say.
Bytes GltfFile::part_of_buffer(const JsonView& json) {
  const int index = json["buffer"].index(root()["buffers"].size());
  if (index < 0) json.fail("has no buffer");
  const Bytes bytes = buffer(static_cast<std::size_t>(index));
  const std::uint64_t offset = json["byteOffset"].count(0);
  const std::uint64_t length = json["byteLength"].count(0);
  if (offset > bytes.size() || length > bytes.size() - offset) json.fail("reaches past the end of its buffer");
  return bytes.subspan(offset, length);
}

Bytes GltfFile::buffer_view(std::size_t view) {
  const JsonView json = root()["bufferViews"][view];
  if (!json["extensions"].present()) return part_of_buffer(json);
  const JsonView compressed = json["extensions"]["EXT_meshopt_compression"];
  if (!compressed.present() || (!LIGHTWELL_MESHOPT && has_data(json["buffer"]))) return part_of_buffer(json);
  const auto found = decompressed_views_.find(view);
  if (found != decompressed_views_.end()) return found->second;
  std::vector<std::uint8_t> bytes = decode_meshopt(*this, compressed, part_of_buffer(compressed));
  if (bytes.size() < json["byteLength"].count(0)) json.fail("promises more bytes than its compressed data holds");
  return decompressed_views_.emplace(view, std::move(bytes)).first->second;
}

// Whether a buffer has data of its own: it is no fallback for what compressed buffer views hold.
bool GltfFile::has_data(const JsonView& buffer) const {
  const int index = buffer.index(root()["buffers"].size());
  if (index < 0) return false;
  const JsonView json = root()["buffers"][static_cast<std::size_t>(index)];
  return json["uri"].present() || (index == 0 && binary_chunk_.data() != nullptr);
}

std::size_t GltfFile::buffer_view_stride(std::size_t view) const {
  const JsonView stride = root()["bufferViews"][view]["byteStride"];
  const std::uint64_t bytes = stride.count(0);
  if (bytes > 65536) stride.fail("is larger than glTF allows");
  return bytes;
}

std::optional<GltfFile::EncodedImage> GltfFile::image(std::size_t image) {
  try {
    return read_image(image);
  } catch (const ForbiddenFile&) {
    throw;
  } catch (const InputError& error) {
    log_warning(std::string(error.what()) + ": no such texture");
    return std::nullopt;
  }
}

std::optional<GltfFile::EncodedImage> GltfFile::read_image(std::size_t image) {
  const JsonView json = root()["images"][image];
  const std::string embedded_subject = path_ + " (image " + std::to_string(image) + ")";
  const int view = json["bufferView"].index(root()["bufferViews"].size());
  if (view >= 0) return EncodedImage{embedded_subject, buffer_view(static_cast<std::size_t>(view))};

  if (embedded_images_.contains(image)) return EncodedImage{embedded_subject, embedded_images_[image]};
  const std::string uri = json["uri"].string("");
  if (uri.empty()) json.fail("has no data");
  if (auto embedded = decode_data_uri(path_, uri))
    return EncodedImage{embedded_subject, embedded_images_.emplace(image, std::move(*embedded)).first->second};
  const std::string name = image_name(uri);
  const std::optional<std::string> file_path = files_.find_file(path_, name);
  if (!file_path) {
    log_warning(resolve_name(path_, name) + ": texture not found, used by " + path_);
    return std::nullopt;
  }
  return EncodedImage{*file_path, external_file(*file_path)};
}

}  // namespace lightwell
