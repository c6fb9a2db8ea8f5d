#include "scene/mtl.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <optional>
#include <utility>

#include "core/log.h"
#include "lightwell/error.h"
#include "scene/file_notes.h"
#include "scene/opacity_map.h"
#include "scene/text_scanner.h"
#include "scene/uri.h"

namespace lightwell {

namespace {

struct MapStatement {
  std::string file;  // with what may be a comment behind it, or a part of the name
  glm::mat3x2 transform{1.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f};
  bool clamp = false;
  char channel = 0;  // -imfchan: r, g, b, m (alpha), l (luminance); 0: not given
  float bump_scale = 1.0f;
};

class MtlReader {
 public:
  MtlReader(const std::string& path, MtlMaterials& materials)
      : path_(path), materials_(materials), scene_(materials.scene), notes_(path) {}

  void read(std::string_view text);

 private:
  // Of the material that is being read, until it is complete.
  struct Current {
    int index = -1;
    bool has_color = false;
    std::optional<float> opacity;       // d
    std::optional<float> transparency;  // Tr
    long opacity_line = 0;
    std::optional<MapStatement> opacity_map;
    std::string color_file;  // of map_Kd
  };

  void begin_material(std::string_view name);
  void statement(std::string_view key, std::string_view rest, std::string_view rest_with_comment, Material& material);
  bool map_statement(std::string_view key, std::string_view rest, Material& material);
  void leave_out(std::string_view key, std::string_view rest);
  std::optional<glm::vec3> color(std::string_view key, std::string_view rest);
  std::optional<float> number(std::string_view key, std::string_view rest);
  MapStatement parse_map(std::string_view rest);
  bool option(std::string_view name, std::string_view& rest, MapStatement& map, glm::vec2& offset, glm::vec2& scale);
  std::optional<std::string> find(const std::string& file);
  std::optional<std::string> search(const std::string& file) const;
  TextureRef texture(const MapStatement& map);
  void finish_material();
  void finish_opacity(Material& material);
  void finish_opacity_map(Material& material);
  int masked_texture(int base, const MapStatement& map, const std::string& file);
  void complain(const std::string& what) { notes_.add("line " + std::to_string(line_), what); }

  const std::string& path_;
  MtlMaterials& materials_;
  Scene& scene_;
  FileNotes notes_;
  std::map<std::string, int> textures_;  // of file and use; -1: none
  std::map<std::string, std::optional<std::string>> found_;
  Current current_;
  long line_ = 0;
};

std::string in_quotes(std::string_view text) {
  return std::string(1, '\'').append(text.substr(0, 80)).append("'");
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

std::optional<float> MtlReader::number(std::string_view key, std::string_view rest) {
  const std::optional<float> value = parse_float(take_word(rest));
  if (!value) complain(in_quotes(key) + " without a number that can be read: left out");
  return value;
}

// One or three numbers; spectral and XYZ colours are not supported.
std::optional<glm::vec3> MtlReader::color(std::string_view key, std::string_view rest) {
  glm::vec3 rgb(0.0f);
  for (int c = 0; c < 3; ++c) {
    if (c == 1 && trimmed(rest).empty()) {
      rgb = glm::vec3(rgb.r);
      break;
    }
    const std::optional<float> value = number(key, rest);
    if (!value) return std::nullopt;
    take_word(rest);
    rgb[c] = std::clamp(*value, 0.0f, kMaxLight);
    if (rgb[c] != *value) complain(in_quotes(key) + " is negative or more than 1e18: limited");
  }
  return rgb;
}

// Reads the arguments of a map's option. False if it is none that is known: then it begins the file's name.
bool MtlReader::option(std::string_view name, std::string_view& rest, MapStatement& map, glm::vec2& offset,
                       glm::vec2& scale) {
  if (name == "-o" || name == "-s" || name == "-t") {
    for (int i = 0; i < 3; ++i) {
      std::string_view ahead = rest;
      const std::optional<float> value = parse_float(take_word(ahead));
      if (!value) break;
      if (i < 2 && name != "-t") (name == "-o" ? offset : scale)[i] = *value;
      if (name == "-t" && *value != 0.0f) complain("turbulence of a map (-t) is not shown");
      rest = ahead;
    }
    return true;
  }
  if (name == "-mm") {
    const std::optional<float> base = parse_float(take_word(rest));
    const std::optional<float> gain = parse_float(take_word(rest));
    if (base != 0.0f || gain != 1.0f) complain("the range of a map (-mm) is not changed");
    return true;
  }
  if (name == "-clamp") {
    map.clamp = take_word(rest) == "on";
  } else if (name == "-bm") {
    map.bump_scale = parse_float(take_word(rest)).value_or(1.0f);
  } else if (name == "-imfchan") {
    const std::string_view channel = take_word(rest);
    map.channel = channel.empty() ? char{0} : channel[0];
  } else if (name == "-blendu" || name == "-blendv" || name == "-boost" || name == "-cc" || name == "-texres") {
    take_word(rest);  // of how a renderer filters
  } else if (name == "-type") {
    take_word(rest);
    complain("a reflection's map has no place of its own (-type): not shown as one");
  } else {
    return false;
  }
  return true;
}

// Options come first, each with its own number of arguments; what is left is the file name, spaces and all.
MapStatement MtlReader::parse_map(std::string_view rest) {
  MapStatement map;
  glm::vec2 offset(0.0f), scale(1.0f);
  while (trimmed(rest).starts_with('-')) {
    std::string_view ahead = rest;
    const std::string_view name = take_word(ahead);
    if (!option(name, ahead, map, offset, scale)) break;
    rest = ahead;
  }
  map.file = std::string(trimmed(rest));
  // The file's v points up, ours down: v' = 1 - (offset + scale * (1 - v)).
  map.transform = {scale.x, 0.0f, 0.0f, scale.y, offset.x, 1.0f - offset.y - scale.y};
  return map;
}

std::optional<std::string> MtlReader::find(const std::string& file) {
  const auto [entry, is_new] = found_.try_emplace(file);
  if (is_new) entry->second = search(file);
  return entry->second;
}

// A name may hold "#": it is cut off as a comment only where there is no such file.
std::optional<std::string> MtlReader::search(const std::string& file) const {
  const std::string without_comment(trimmed(std::string_view(file).substr(0, file.find(" #"))));
  try {
    if (without_comment != file)
      if (auto found = materials_.files.find_file(path_, file)) return found;
    if (auto found = materials_.files.find_file(path_, without_comment)) return found;
    log_warning(resolve_name(path_, without_comment) + ": texture not found, used by " + materials_.subject);
  } catch (const ForbiddenFile&) {
    throw;
  } catch (const InputError& error) {
    log_warning(std::string(error.what()) + ": no such texture");
  }
  return std::nullopt;
}

TextureRef MtlReader::texture(const MapStatement& map) {
  if (map.file.empty()) {
    complain("a map without a file name: left out");
    return {};
  }
  const auto [entry, is_new] = textures_.try_emplace(map.file + (map.clamp ? "|clamp" : "|repeat"), -1);
  if (is_new) {
    if (const std::optional<std::string> file = find(map.file))
      entry->second = materials_.textures.add_file(materials_.files, *file, map.file);
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
  current_ = Current();
  current_.index = static_cast<int>(scene_.materials.size());
  scene_.materials.push_back(plain_material(std::string(name)));
  materials_.indices[std::string(name)] = current_.index;
}

// The base texture (-1: white) with the alpha that another file gives. Returns its index, or that of the base where
// there is no such file.
int MtlReader::masked_texture(int base, const MapStatement& map, const std::string& file) {
  const auto [entry, is_new] = textures_.try_emplace(std::to_string(base) + "|mask|" + map.channel + file, base);
  if (!is_new) return entry->second;
  const std::optional<Texture> mask = materials_.textures.decode_file(materials_.files, file, map.file);
  if (!mask) return base;
  const Texture* color = base < 0 ? nullptr : &scene_.textures[static_cast<std::size_t>(base)];
  const ImageSize size = masked_size(color, *mask);
  materials_.textures.charge(static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height));
  Texture made = with_mask(color, *mask, map.channel);
  const bool clamp = color ? color->wrap_u == Wrap::kClampToEdge : map.clamp;
  if (clamp) made.wrap_u = made.wrap_v = Wrap::kClampToEdge;
  return entry->second = materials_.textures.append(std::move(made));
}

void MtlReader::finish_opacity_map(Material& material) {
  if (!current_.opacity_map) return;
  const MapStatement& map = *current_.opacity_map;
  TextureRef& base = material.base_color_texture;
  if (map.file.empty()) return complain("a map without a file name: left out");
  // Most often a file with alpha is both maps.
  if (map.file == current_.color_file && map.channel == 0 && base.texture >= 0 &&
      has_alpha_below(scene_.textures[static_cast<std::size_t>(base.texture)], 255))
    return;
  const std::optional<std::string> file = find(map.file);
  if (!file) return;
  if (base.texture < 0)
    base.transform = map.transform;
  else if (base.transform != map.transform)
    complain("map_d of " + in_quotes(material.name) + " is laid as its map_Kd, not by options of its own");
  base.texture = masked_texture(base.texture, map, *file);
}

void MtlReader::finish_opacity(Material& material) {
  const float alpha = std::clamp(current_.opacity.value_or(1.0f - current_.transparency.value_or(0.0f)), 0.0f, 1.0f);
  material.base_color.a = alpha;
  if (alpha == 1.0f) return;
  material.alpha_mode = AlphaMode::kBlend;
  notes_.add("line " + std::to_string(current_.opacity_line), "material " + in_quotes(material.name) +
                                                                  " lets light through (d, Tr): shown " +
                                                                  (alpha < 0.5f ? "as if it were not there" : "solid"));
}

void MtlReader::finish_material() {
  if (current_.index < 0) return;
  Material& material = scene_.materials[static_cast<std::size_t>(current_.index)];
  const bool textured = material.base_color_texture.texture >= 0;
  // A texture multiplies Kd; some exporters leave Kd out or black beside one.
  const bool black = glm::vec3(material.base_color) == glm::vec3(0.0f);
  if (textured && (!current_.has_color || black)) material.base_color = glm::vec4(1.0f);
  if (material.emission_texture.texture >= 0 && material.emission == glm::vec3(0.0f))
    material.emission = glm::vec3(1.0f);
  finish_opacity(material);
  finish_opacity_map(material);
  const int texture = material.base_color_texture.texture;
  if (texture >= 0 && material.alpha_mode == AlphaMode::kOpaque &&
      has_alpha_below(scene_.textures[static_cast<std::size_t>(texture)], 128))
    material.alpha_mode = AlphaMode::kMask;
}

bool MtlReader::map_statement(std::string_view key, std::string_view rest, Material& material) {
  if (key == "map_kd") {
    const MapStatement map = parse_map(rest);
    current_.color_file = map.file;
    material.base_color_texture = texture(map);
  } else if (key == "map_ke") {
    material.emission_texture = texture(parse_map(rest));
  } else if (key == "map_d") {
    current_.opacity_map = parse_map(rest);
  } else if (key == "map_bump" || key == "bump") {
    const MapStatement map = parse_map(rest);
    material.bump_texture = texture(map);
    material.bump_scale = map.bump_scale;
    complain("bump maps are read, but not shown");
  } else if (key == "norm" || key == "map_kn") {
    material.normal_texture = texture(parse_map(rest));
    complain("normal maps are read, but not shown");
  } else {
    return false;
  }
  return true;
}

// What a Lambert surface does not have. Ambient light is none of a renderer that computes it; some statements only say
// how others look.
void MtlReader::leave_out(std::string_view key, std::string_view rest) {
  for (const std::string_view silent : {"ka", "ns", "sharpness", "map_ka", "pcr", "anisor"})
    if (key == silent) return;
  if (key == "illum") {
    constexpr float kHighlights = 2.0f;  // those of Ks; larger numbers are mirrors, glass and shadows alone
    if (parse_float(take_word(rest)).value_or(0.0f) > kHighlights) complain("'illum' 3 and more: shown diffuse");
    return;
  }
  bool neutral = !trimmed(rest).empty();  // of numbers: 0, and for the filter of glass 1
  const float nothing = key == "tf" ? 1.0f : 0.0f;
  while (!trimmed(rest).empty()) neutral = parse_float(take_word(rest)) == nothing && neutral;
  if (!neutral) complain(in_quotes(key) + " is not shown");
}

void MtlReader::statement(std::string_view key, std::string_view rest, std::string_view rest_with_comment,
                          Material& material) {
  if (map_statement(key, rest_with_comment, material)) return;
  if (key == "kd") {
    if (const auto rgb = color(key, rest)) {
      material.base_color = glm::vec4(*rgb, 1.0f);
      current_.has_color = true;
    }
  } else if (key == "ke") {
    material.emission = color(key, rest).value_or(material.emission);
  } else if (key == "ni") {
    material.ior = number(key, rest).value_or(material.ior);
  } else if (key == "pr") {
    material.roughness = number(key, rest).value_or(material.roughness);
  } else if (key == "pm") {
    material.metallic = number(key, rest).value_or(material.metallic);
  } else if (key == "d" || key == "tr") {
    std::string_view ahead = rest;
    if (take_word(ahead) == "-halo") {
      rest = ahead;
      complain("'d -halo' is the same in all directions");
    }
    if (const auto value = number(key, rest)) (key == "d" ? current_.opacity : current_.transparency) = value;
    current_.opacity_line = line_;
  } else {
    leave_out(key, rest);
  }
}

void MtlReader::read(std::string_view text) {
  LineReader lines(text);
  std::string_view line;
  while (lines.next(line)) {
    line_ = lines.line_number();
    std::string_view with_comment = lines.with_comment();
    const std::string key = lower_case(take_word(line));
    take_word(with_comment);
    if (key == "newmtl") {
      begin_material(trimmed(with_comment));
      materials_.indices.try_emplace(std::string(trimmed(line)), current_.index);  // of who reads a comment behind it
    } else if (current_.index >= 0 && !key.empty()) {
      statement(key, line, with_comment, scene_.materials[static_cast<std::size_t>(current_.index)]);
    } else if (!key.empty()) {
      complain(in_quotes(key) + " stands before the first material: left out");
    }
  }
  finish_material();
  notes_.log();
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
  std::vector<std::uint8_t> bytes;
  try {
    bytes = materials.files.read(path);
  } catch (const ForbiddenFile&) {
    throw;
  } catch (const InputError& error) {
    return log_warning(std::string(error.what()) + ": no such material library, used by " + materials.subject);
  }
  MtlReader(path, materials).read({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace lightwell
