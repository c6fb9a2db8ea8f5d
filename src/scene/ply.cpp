// PLY importer: ASCII and binary of either byte order; vertices with positions, optional normals and texture
// coordinates; faces as lists of any integer type. Other elements and properties are skipped.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>
#include <type_traits>

#include "lightwell/error.h"
#include "scene/geometry.h"
#include "scene/importers.h"
#include "scene/mtl.h"
#include "scene/text_scanner.h"

namespace lightwell {

namespace {

enum class Scalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

std::size_t size_of(Scalar type) {
  constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

struct Property {
  std::string name;
  bool is_list = false;
  Scalar count_type = Scalar::kUint8;
  Scalar type = Scalar::kFloat;
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

constexpr std::size_t kMaxHeaderLine = 10000;

class PlyReader {
 public:
  PlyReader(const std::string& path, const SceneFiles& files) : path_(path), bytes_(files.read(path)) {
    body_ = {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()};
  }
  Scene read();

 private:
  void read_header();
  void header_line(std::string_view line);
  Scalar parse_type(std::string_view name) const;
  void check_count(const Element& element) const;
  void read_vertices(const Element& element);
  void read_faces(const Element& element);
  void skip(const Element& element);

  double scalar(Scalar type);
  template <typename T>
  double binary_scalar();
  std::uint64_t list_size(const Property& property);
  [[noreturn]] void fail(const std::string& cause) const { throw InputError(path_, cause); }

  const std::string& path_;
  std::vector<std::uint8_t> bytes_;
  std::string_view body_;  // what has not been read yet
  bool ascii_ = true;
  bool swap_ = false;  // byte order differs from this machine's
  std::vector<Element> elements_;
  Primitive primitive_;
};

Scalar PlyReader::parse_type(std::string_view name) const {
  struct Name {
    std::string_view name;
    Scalar type;
  };
  constexpr std::array<Name, 16> kNames = {{{"char", Scalar::kInt8},
                                            {"int8", Scalar::kInt8},
                                            {"uchar", Scalar::kUint8},
                                            {"uint8", Scalar::kUint8},
                                            {"short", Scalar::kInt16},
                                            {"int16", Scalar::kInt16},
                                            {"ushort", Scalar::kUint16},
                                            {"uint16", Scalar::kUint16},
                                            {"int", Scalar::kInt32},
                                            {"int32", Scalar::kInt32},
                                            {"uint", Scalar::kUint32},
                                            {"uint32", Scalar::kUint32},
                                            {"float", Scalar::kFloat},
                                            {"float32", Scalar::kFloat},
                                            {"double", Scalar::kDouble},
                                            {"float64", Scalar::kDouble}}};
  for (const Name& known : kNames)
    if (name == known.name) return known.type;
  fail("unknown PLY type '" + std::string(name.substr(0, 20)) + "'");
}

void PlyReader::header_line(std::string_view line) {
  const std::string_view key = take_word(line);
  if (key == "format") {
    const std::string_view format = take_word(line);
    ascii_ = format == "ascii";
    if (!ascii_ && format != "binary_little_endian" && format != "binary_big_endian") fail("unknown PLY format");
    swap_ = (format == "binary_big_endian") != (std::endian::native == std::endian::big);
  } else if (key == "element") {
    Element element;
    element.name = take_word(line);
    const auto count = parse_integer(take_word(line));
    if (!count || *count < 0) fail("malformed PLY header: element count");
    element.count = static_cast<std::uint64_t>(*count);
    elements_.push_back(std::move(element));
  } else if (key == "property") {
    if (elements_.empty()) fail("malformed PLY header: property before any element");
    Property property;
    std::string_view type = take_word(line);
    property.is_list = type == "list";
    if (property.is_list) {
      property.count_type = parse_type(take_word(line));
      type = take_word(line);
    }
    property.type = parse_type(type);
    property.name = take_word(line);
    elements_.back().properties.push_back(std::move(property));
  } else if (!key.empty() && key != "comment" && key != "obj_info") {
    fail("malformed PLY header: '" + std::string(key.substr(0, 20)) + "'");
  }
}

void PlyReader::read_header() {
  const auto take_line = [&] {
    const std::size_t end = body_.find('\n');
    if (end == std::string_view::npos || end > kMaxHeaderLine) fail("malformed PLY header");
    const std::string_view line = trimmed(body_.substr(0, end));
    body_.remove_prefix(end + 1);
    return line;
  };
  if (!body_.starts_with("ply") || take_line() != "ply") fail("not a PLY file");
  for (std::string_view line = take_line(); line != "end_header"; line = take_line()) header_line(line);
}

// Before anything is allocated: an element takes at least this much of the file.
void PlyReader::check_count(const Element& element) const {
  std::uint64_t least = 0;
  for (const Property& p : element.properties) least += ascii_ ? 1 : size_of(p.is_list ? p.count_type : p.type);
  if (least > 0 && element.count > body_.size() / least + 1)
    fail("truncated: " + std::to_string(element.count) + " of '" + element.name.substr(0, 40) + "' promised");
  if (element.count > std::numeric_limits<std::uint32_t>::max())
    fail("too many of '" + element.name.substr(0, 40) + "'");
}

template <typename T>
double PlyReader::binary_scalar() {
  if (body_.size() < sizeof(T)) fail("truncated");
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), body_.data(), sizeof(T));
  if (swap_) std::reverse(raw.begin(), raw.end());
  body_.remove_prefix(sizeof(T));
  return static_cast<double>(std::bit_cast<T>(raw));
}

double PlyReader::scalar(Scalar type) {
  if (ascii_) {
    constexpr std::string_view kBlanks = " \t\r\n\v\f";
    body_.remove_prefix(std::min(body_.find_first_not_of(kBlanks), body_.size()));
    const std::string_view word = body_.substr(0, body_.find_first_of(kBlanks));
    if (word.empty()) fail("truncated");
    body_.remove_prefix(word.size());
    const auto value = parse_double(word);
    if (!value) fail("'" + std::string(word.substr(0, 20)) + "' is not a number");
    return *value;
  }
  switch (type) {
    case Scalar::kInt8:
      return binary_scalar<std::int8_t>();
    case Scalar::kUint8:
      return binary_scalar<std::uint8_t>();
    case Scalar::kInt16:
      return binary_scalar<std::int16_t>();
    case Scalar::kUint16:
      return binary_scalar<std::uint16_t>();
    case Scalar::kInt32:
      return binary_scalar<std::int32_t>();
    case Scalar::kUint32:
      return binary_scalar<std::uint32_t>();
    case Scalar::kFloat:
      return binary_scalar<float>();
    case Scalar::kDouble:
      break;
  }
  return binary_scalar<double>();
}

std::uint64_t PlyReader::list_size(const Property& property) {
  const double size = scalar(property.count_type);
  if (!(size >= 0.0) || size != std::floor(size) || size > static_cast<double>(body_.size()))
    fail("a list has an impossible length");
  return static_cast<std::uint64_t>(size);
}

void PlyReader::skip(const Element& element) {
  if (element.properties.empty()) return;
  for (std::uint64_t i = 0; i < element.count; ++i)
    for (const Property& property : element.properties)
      for (std::uint64_t n = property.is_list ? list_size(property) : 1; n > 0; --n) scalar(property.type);
}

void PlyReader::read_vertices(const Element& element) {
  // Which number of a vertex each property is: x y z, nx ny nz, u v; the last place takes what is not needed.
  constexpr std::array<std::array<std::string_view, 4>, 8> kNames = {{{"x"},
                                                                      {"y"},
                                                                      {"z"},
                                                                      {"nx"},
                                                                      {"ny"},
                                                                      {"nz"},
                                                                      {"u", "s", "texture_u", "texcoord_u"},
                                                                      {"v", "t", "texture_v", "texcoord_v"}}};
  constexpr std::size_t kUnused = kNames.size();
  std::vector<std::size_t> places;
  std::array<bool, kUnused + 1> present{};
  for (const Property& property : element.properties) {
    std::size_t place = 0;
    const auto named = [&](const auto& names) { return std::find(names.begin(), names.end(), property.name); };
    while (place < kUnused && (property.name.empty() || named(kNames[place]) == kNames[place].end())) ++place;
    places.push_back(property.is_list ? kUnused : place);
    present[places.back()] = true;
  }
  if (!present[0] || !present[1] || !present[2]) fail("vertices have no x, y, z");
  const bool has_normals = present[3] && present[4] && present[5];
  const bool has_texcoords = present[6] && present[7];

  std::array<float, kUnused + 1> v{};
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (std::size_t p = 0; p < places.size(); ++p) {
      const Property& property = element.properties[p];
      for (std::uint64_t n = property.is_list ? list_size(property) : 1; n > 0; --n)
        v[places[p]] = static_cast<float>(scalar(property.type));
    }
    primitive_.positions.push_back({v[0], v[1], v[2]});
    if (has_normals) primitive_.normals.push_back({v[3], v[4], v[5]});
    if (has_texcoords) primitive_.texcoords[0].push_back({v[6], 1.0f - v[7]});  // v points up in PLY
  }
}

void PlyReader::read_faces(const Element& element) {
  std::vector<std::uint32_t> polygon;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (const Property& property : element.properties) {
      const bool is_polygon =
          property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
      polygon.clear();
      for (std::uint64_t n = property.is_list ? list_size(property) : 1; n > 0; --n) {
        const double index = scalar(property.type);
        if (!is_polygon) continue;
        if (!(index >= 0.0) || index > std::numeric_limits<std::uint32_t>::max() || index != std::floor(index))
          fail("face " + std::to_string(i) + ": bad vertex index");
        polygon.push_back(static_cast<std::uint32_t>(index));
      }
      const std::vector<std::uint32_t> triangles = triangles_of_fan(polygon);
      primitive_.indices.insert(primitive_.indices.end(), triangles.begin(), triangles.end());
    }
  }
}

Scene PlyReader::read() {
  read_header();
  for (const Element& element : elements_) {
    check_count(element);
    if (element.name == "vertex" && primitive_.positions.empty())
      read_vertices(element);
    else if (element.name == "face")
      read_faces(element);
    else
      skip(element);
  }
  if (primitive_.indices.empty()) fail("has no faces");
  const std::size_t count = primitive_.positions.size();
  for (const std::uint32_t i : primitive_.indices)
    if (i >= count) fail("a face uses vertex " + std::to_string(i) + " of " + std::to_string(count));
  if (primitive_.normals.empty())
    make_flat(primitive_);
  else
    repair_normals(primitive_);

  Scene scene;
  scene.materials.push_back(plain_material("grey"));
  primitive_.material = 0;
  scene.meshes.emplace_back().primitives.push_back(std::move(primitive_));
  scene.nodes.emplace_back().mesh = 0;
  return scene;
}

}  // namespace

Scene import_ply(const std::string& path, const SceneFiles& files) {
  return PlyReader(path, files).read();
}

}  // namespace lightwell
