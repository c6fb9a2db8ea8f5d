#include "scene/mtl.h"

#include <array>
#include <optional>
#include <span>

#include "core/log.h"
#include "lightwell/error.h"
#include "scene/text_scanner.h"
#include "scene/uri.h"

namespace lightwell {

namespace {

struct MapStatement {
  std::string file;
  glm::mat3x2 transform{1.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f};
  bool clamp = false;
};

class MtlReader {
 public:
  MtlReader(const std::string& path, MtlMaterials& materials)
      : path_(path), materials_(materials), scene_(materials.scene) {}

  void read(std::string_view text);

 private:
  void begin_material(std::string_view name);
  void statement(std::string_view key, std::string_view rest, Material& material);
  glm::vec3 color(std::string_view rest) const;
  float number(std::string_view rest) const;
  MapStatement parse_map(std::string_view rest) const;
  TextureRef texture(std::string_view rest);
  void finish_material();
  [[noreturn]] void fail(const std::string& cause) const {
    throw InputError(path_, "line " + std::to_string(line_) + ": " + cause);
  }

  const std::string& path_;
  MtlMaterials& materials_;
  Scene& scene_;
  std::map<std::string, int> textures_;  // of file and wrap mode; -1: none
  int current_ = -1;
  bool has_color_ = false;
  long line_ = 0;
};

float MtlReader::number(std::string_view rest) const {
  const std::optional<float> value = parse_float(take_word(rest));
  if (!value) fail("expected a number");
  return *value;
}

// One or three numbers; spectral and XYZ colours are not supported.
glm::vec3 MtlReader::color(std::string_view rest) const {
  glm::vec3 rgb(number(rest));
  take_word(rest);
  if (trimmed(rest).empty()) return rgb;
  rgb.g = number(rest);
  take_word(rest);
  rgb.b = number(rest);
  return rgb;
}

// Options come first, each with its own number of arguments; what is left is the file name, spaces and all.
MapStatement MtlReader::parse_map(std::string_view rest) const {
  MapStatement map;
  std::array<float, 2> offset = {0.0f, 0.0f};
  std::array<float, 2> scale = {1.0f, 1.0f};
  while (trimmed(rest).starts_with('-')) {
    const std::string_view option = take_word(rest);
    if (option == "-o" || option == "-s" || option == "-t") {
      for (int i = 0; i < 3; ++i) {
        std::string_view ahead = rest;
        const std::optional<float> value = parse_float(take_word(ahead));
        if (!value) break;
        if (i < 2 && option != "-t") (option == "-o" ? offset : scale)[static_cast<std::size_t>(i)] = *value;
        rest = ahead;
      }
    } else if (option == "-mm") {
      take_word(rest);
      take_word(rest);
    } else {
      const std::string_view value = take_word(rest);
      if (option == "-clamp") map.clamp = value == "on";
    }
  }
  map.file = std::string(trimmed(rest));
  // The file's v points up, ours down: v' = 1 - (offset + scale * (1 - v)).
  map.transform = {scale[0], 0.0f, 0.0f, scale[1], offset[0], 1.0f - offset[1] - scale[1]};
  return map;
}

TextureRef MtlReader::texture(std::string_view rest) {
  const MapStatement map = parse_map(rest);
  if (map.file.empty()) return {};
  const std::string file = resolve_name(path_, map.file);
  const auto [entry, is_new] = textures_.try_emplace(file + (map.clamp ? "|clamp" : "|repeat"), -1);
  if (is_new) {
    if (materials_.files.exists(file))
      entry->second = materials_.textures.add(file, map.file, materials_.files.read(file));
    else
      log_warning(file + ": texture not found, used by " + materials_.subject);
    if (map.clamp && entry->second >= 0) {
      Texture& texture = scene_.textures[static_cast<std::size_t>(entry->second)];
      texture.wrap_u = texture.wrap_v = Wrap::kClampToEdge;
    }
  }
  TextureRef ref;
  ref.texture = entry->second;
  if (ref.texture >= 0) ref.transform = map.transform;
  return ref;
}

void MtlReader::begin_material(std::string_view name) {
  finish_material();
  current_ = static_cast<int>(scene_.materials.size());
  scene_.materials.push_back(plain_material(std::string(name)));
  materials_.indices[std::string(name)] = current_;
  has_color_ = false;
}

bool has_transparent_texel(const Texture& texture) {
  for (std::size_t i = 3; i < texture.rgba.size(); i += 4)
    if (texture.rgba[i] < 128) return true;
  return false;
}

void MtlReader::finish_material() {
  if (current_ < 0) return;
  Material& material = scene_.materials[static_cast<std::size_t>(current_)];
  const bool textured = material.base_color_texture.texture >= 0;
  // A texture multiplies Kd; some exporters leave Kd out or black beside one.
  const bool black = glm::vec3(material.base_color) == glm::vec3(0.0f);
  if (textured && (!has_color_ || black)) material.base_color = glm::vec4(1.0f, 1.0f, 1.0f, material.base_color.a);
  if (material.emission_texture.texture >= 0 && material.emission == glm::vec3(0.0f))
    material.emission = glm::vec3(1.0f);
  if (textured && has_transparent_texel(scene_.textures[static_cast<std::size_t>(material.base_color_texture.texture)]))
    material.alpha_mode = AlphaMode::kMask;
}

void MtlReader::statement(std::string_view key, std::string_view rest, Material& material) {
  if (key == "Kd") {
    material.base_color = glm::vec4(color(rest), material.base_color.a);
    has_color_ = true;
  } else if (key == "Ke") {
    material.emission = color(rest);
  } else if (key == "Ni") {
    material.ior = number(rest);
  } else if (key == "map_Kd") {
    material.base_color_texture = texture(rest);
  } else if (key == "map_Ke") {
    material.emission_texture = texture(rest);
  }
}

void MtlReader::read(std::string_view text) {
  LineReader lines(text);
  std::string_view line;
  while (lines.next(line)) {
    line_ = lines.line_number();
    const std::string_view key = take_word(line);
    if (key == "newmtl")
      begin_material(trimmed(line));
    else if (current_ >= 0)
      statement(key, line, scene_.materials[static_cast<std::size_t>(current_)]);
  }
  finish_material();
}

}  // namespace

Material plain_material(const std::string& name) {
  Material material;
  material.name = name;
  material.base_color = glm::vec4(0.8f, 0.8f, 0.8f, 1.0f);
  material.double_sided = true;
  material.metallic = 0.0f;
  return material;
}

void read_mtl(const std::string& path, MtlMaterials& materials) {
  if (!materials.files.exists(path)) {
    log_warning(path + ": material library not found, used by " + materials.subject);
    return;
  }
  const std::vector<std::uint8_t> bytes = materials.files.read(path);
  MtlReader(path, materials).read({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace lightwell
