// Wavefront OBJ importer: one mesh, one primitive a material. Faces without normals are flat.
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lightwell/error.h"
#include "lightwell/metrics.h"
#include "scene/file_notes.h"
#include "scene/geometry.h"
#include "scene/importers.h"
#include "scene/mtl.h"
#include "scene/polygon.h"
#include "scene/text_scanner.h"
#include "scene/uri.h"

namespace lightwell {

namespace {

bool is_finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// A corner of a face: indices into the file's lists, -1 if not given.
struct Corner {
  int position = -1;
  int texcoord = -1;
  int normal = -1;
  bool operator==(const Corner&) const = default;
};

struct CornerHash {
  std::size_t operator()(const Corner& c) const {
    std::uint64_t h = static_cast<std::uint32_t>(c.position);
    h = h * 0x9e3779b97f4a7c15u + static_cast<std::uint32_t>(c.texcoord);
    h = h * 0x9e3779b97f4a7c15u + static_cast<std::uint32_t>(c.normal);
    return h ^ (h >> 29);
  }
};

struct PrimitiveBuilder {
  Primitive primitive;
  std::unordered_map<Corner, std::uint32_t, CornerHash> vertices;  // those that have a normal of the file
  bool has_texcoords = false;
  long line_without_texcoords = 0;
};

constexpr float kNoColor = -1.0f;

class ObjReader {
 public:
  ObjReader(const std::string& path, const SceneFiles& files)
      : path_(path), files_(files), notes_(path), materials_{path, files, scene_, TextureLoader(scene_, path), {}} {}
  Scene read();

 private:
  void statement(std::string_view key, std::string_view rest, std::string_view rest_with_comment);
  void vertex(std::string_view rest);
  void texcoord(std::string_view rest);
  void normal(std::string_view rest);
  bool parse_corner(std::string_view word, Corner& corner);
  int optional_index(std::string_view word, std::size_t count, const char* what);
  void add_face(std::string_view rest);
  std::uint32_t add_vertex(PrimitiveBuilder& builder, const Corner& corner, const glm::vec3& normal);
  PrimitiveBuilder& builder();
  void use_material(std::string_view name, std::string_view name_with_comment);
  void use_libraries(std::string_view names, std::string_view names_with_comment);
  void finish_colors(Primitive& primitive) const;
  void note_missing_texcoords();
  void build_mesh();
  void complain(const std::string& what) { notes_.add("line " + std::to_string(line_), what); }

  const std::string& path_;
  const SceneFiles& files_;
  Scene scene_;
  FileNotes notes_;
  MtlMaterials materials_;
  glm::dvec3 base_{0.0};              // FarVertices
  std::vector<glm::vec3> positions_;  // less base_; not finite: no vertex
  std::vector<glm::vec3> colors_;     // of the first positions, as the file has them; none: kNoColor
  std::vector<glm::vec2> texcoords_;
  std::vector<glm::vec3> normals_;
  float largest_color_ = 0.0f;
  std::set<std::string> libraries_;
  std::map<int, PrimitiveBuilder> builders_;  // by material
  PrimitiveBuilder* builder_ = nullptr;       // of the current material, once it has a face
  int material_ = -1;
  bool smooth_ = false;  // faces without normals ask for some
  std::vector<Corner> face_;
  std::vector<glm::vec3> face_positions_;
  std::vector<std::uint32_t> face_vertices_;
  std::vector<std::uint32_t> face_triangles_;
  Triangulator triangulator_;
  long line_ = 0;
};

// Numbers up to the first word that is none, or too large for a float.
template <typename T, std::size_t kMost>
std::size_t parse_numbers(std::string_view rest, std::array<T, kMost>& numbers) {
  std::size_t count = 0;
  for (; count < kMost; ++count) {
    const std::optional<double> number = parse_double(take_word(rest));
    if (!number || std::abs(*number) > double{std::numeric_limits<float>::max()}) break;
    numbers[count] = static_cast<T>(*number);
  }
  return count;
}

// Of all vertices of a file. Where one is near 0, and that is the rule, only those before it are read.
glm::dvec3 find_base(std::string_view text) {
  FarVertices vertices;
  LineReader lines(text);
  std::string_view line;
  while (lines.next(line)) {
    if (take_word(line) != "v") continue;
    std::array<double, 3> v{};
    if (parse_numbers(line, v) == 3 && !vertices.add({v[0], v[1], v[2]})) break;
  }
  return vertices.base();
}

// x y z, also x y z w; or with a colour, x y z r g b.
void ObjReader::vertex(std::string_view rest) {
  std::array<double, 6> v{};
  const std::size_t count = parse_numbers(rest, v);
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  positions_.push_back(count < 3 ? glm::vec3(kNone) : glm::vec3(glm::dvec3(v[0], v[1], v[2]) - base_));
  if (count < 3) complain("a vertex without three numbers that can be read: its faces are left out");
  if (count < 6) return;
  colors_.resize(positions_.size() - 1, glm::vec3(kNoColor));
  const glm::vec3 color(v[3], v[4], v[5]);
  colors_.push_back(glm::max(color, 0.0f));
  largest_color_ = std::max({largest_color_, color.r, color.g, color.b});
}

void ObjReader::texcoord(std::string_view rest) {
  std::array<float, 2> uv{};
  if (parse_numbers(rest, uv) < (trimmed(rest).find_first_of(" \t") == std::string_view::npos ? 1u : 2u)) {
    complain("a texture coordinate that is no number: taken as 0");
    uv = {};
  }
  texcoords_.push_back({uv[0], 1.0f - uv[1]});  // v points up in OBJ
}

void ObjReader::normal(std::string_view rest) {
  std::array<float, 3> n{};
  if (parse_numbers(rest, n) < 3) {
    complain("a normal without three numbers that can be read: made from its faces");
    n = {};
  }
  normals_.push_back({n[0], n[1], n[2]});
}

// Positive numbers count from 1, negative ones back from the latest entry. -1: none of `count`.
int resolve(std::int64_t number, std::size_t count) {
  const auto size = static_cast<std::int64_t>(count);
  if (number == 0 || number > size || number < -size) return -1;
  return static_cast<int>(number > 0 ? number - 1 : size + number);
}

// Of a texture coordinate or normal, which a corner can do without. 0 is how some programs write none.
int ObjReader::optional_index(std::string_view word, std::size_t count, const char* what) {
  if (word.empty()) return -1;
  const std::optional<std::int64_t> number = parse_integer(word);
  const int index = number ? resolve(*number, count) : -1;
  if (index < 0 && number != std::int64_t{0})
    complain(std::string("a corner's ") + what + " is none of the file: none");
  return index;
}

// v, v/vt, v//vn or v/vt/vn. False, after a complaint, if that is no corner that can be shown.
bool ObjReader::parse_corner(std::string_view word, Corner& corner) {
  std::array<std::string_view, 3> parts;
  for (std::string_view& part : parts) {
    const std::size_t slash = std::min(word.find('/'), word.size());
    part = word.substr(0, slash);
    word.remove_prefix(std::min(slash + 1, word.size()));
  }
  const std::optional<std::int64_t> number = parse_integer(parts[0]);
  corner.position = number ? resolve(*number, positions_.size()) : -1;
  if (!word.empty() || corner.position < 0) {
    complain("a face has a corner that is no vertex of the file so far: left out");
    return false;
  }
  if (!is_finite(positions_[static_cast<std::size_t>(corner.position)])) {
    complain("a face has a vertex that is none: left out");
    return false;
  }
  corner.texcoord = optional_index(parts[1], texcoords_.size(), "texture coordinate");
  corner.normal = optional_index(parts[2], normals_.size(), "normal");
  return true;
}

PrimitiveBuilder& ObjReader::builder() {
  if (!builder_) {
    builder_ = &builders_[material_];
    builder_->primitive.material = material_;
  }
  return *builder_;
}

std::uint32_t ObjReader::add_vertex(PrimitiveBuilder& builder, const Corner& corner, const glm::vec3& normal) {
  Primitive& primitive = builder.primitive;
  const auto index = static_cast<std::uint32_t>(primitive.positions.size());
  if (corner.normal >= 0) {
    const auto [entry, is_new] = builder.vertices.try_emplace(corner, index);
    if (!is_new) return entry->second;
  }
  const auto position = static_cast<std::size_t>(corner.position);
  primitive.positions.push_back(positions_[position]);
  primitive.normals.push_back(corner.normal < 0 ? normal : normals_[static_cast<std::size_t>(corner.normal)]);
  primitive.texcoords[0].push_back(corner.texcoord < 0 ? glm::vec2(0.0f)
                                                       : texcoords_[static_cast<std::size_t>(corner.texcoord)]);
  if (corner.texcoord >= 0)
    builder.has_texcoords = true;
  else if (builder.line_without_texcoords == 0)
    builder.line_without_texcoords = line_;
  if (!colors_.empty()) {
    primitive.colors.resize(index, glm::vec4(kNoColor));
    primitive.colors.push_back(glm::vec4(position < colors_.size() ? colors_[position] : glm::vec3(kNoColor), 1.0f));
  }
  return index;
}

void ObjReader::add_face(std::string_view rest) {
  face_.clear();
  face_positions_.clear();
  bool lacks_normals = false;
  for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
    Corner corner;
    if (!parse_corner(word, corner)) return;
    lacks_normals = lacks_normals || corner.normal < 0;
    face_.push_back(corner);
    face_positions_.push_back(positions_[static_cast<std::size_t>(corner.position)]);
  }
  if (face_.size() < 3) return complain("a face of fewer than three vertices: left out");
  if (lacks_normals && smooth_) complain("smoothing groups are not read: faces without normals are flat");
  const glm::dvec3 area = polygon_area_vector(face_positions_);
  const double length = glm::length(area);
  const glm::vec3 normal =
      length > 0.0 && std::isfinite(length) ? glm::vec3(area / length) : glm::vec3(0.0f, 0.0f, 1.0f);
  PrimitiveBuilder& target = builder();
  face_vertices_.clear();
  for (const Corner& corner : face_) face_vertices_.push_back(add_vertex(target, corner, normal));
  face_triangles_.clear();
  triangulator_.triangulate(face_positions_, face_triangles_);
  for (const std::uint32_t i : face_triangles_) target.primitive.indices.push_back(face_vertices_[i]);
}

void ObjReader::use_material(std::string_view name, std::string_view name_with_comment) {
  auto found = materials_.indices.find(std::string(name_with_comment));
  if (found == materials_.indices.end()) found = materials_.indices.find(std::string(name));
  builder_ = nullptr;
  material_ = found == materials_.indices.end() ? -1 : found->second;
  if (material_ < 0) complain("material '" + std::string(name.substr(0, 80)) + "' is not defined: grey");
}

// One name that may hold spaces and "#", or several names.
void ObjReader::use_libraries(std::string_view names, std::string_view names_with_comment) {
  std::vector<std::string> files;
  for (const std::string_view whole : {names_with_comment, names}) {
    if (trimmed(whole).empty() || !files.empty()) continue;
    if (const auto file = files_.find_file(path_, std::string(trimmed(whole)))) files.push_back(*file);
  }
  if (files.empty())
    for (std::string_view name = take_word(names); !name.empty(); name = take_word(names)) {
      const auto file = files_.find_file(path_, std::string(name));
      files.push_back(file ? *file : resolve_name(path_, std::string(name)));
    }
  for (const std::string& file : files)
    if (libraries_.insert(file).second) read_mtl(file, materials_);
}

bool is_any_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

void ObjReader::statement(std::string_view key, std::string_view rest, std::string_view rest_with_comment) {
  if (key == "v") {
    vertex(rest);
  } else if (key == "vn") {
    normal(rest);
  } else if (key == "vt") {
    texcoord(rest);
  } else if (key == "f" || key == "fo") {
    add_face(rest);
  } else if (key == "usemtl") {
    use_material(trimmed(rest), trimmed(rest_with_comment));
  } else if (key == "mtllib") {
    use_libraries(rest, rest_with_comment);
  } else if (key == "s") {
    const std::string_view group = trimmed(rest);
    smooth_ = group != "off" && group != "0";
  } else if (is_any_of(key, {"p", "l"})) {
    complain("points and lines have no surface: left out");
  } else if (is_any_of(key, {"vp", "cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm", "trim", "hole",
                             "scrv", "sp", "end", "con", "ctech", "stech"})) {
    complain("free-form curves and surfaces are not supported: left out");
  } else if (!is_any_of(key, {"", "o", "g", "mg", "lod", "bevel", "c_interp", "d_interp"})) {
    complain("unknown statement '" + std::string(key.substr(0, 40)) + "': left out");
  }
}

// Programs write what their screens show: sRGB, from 0 to 1 or to 255.
void ObjReader::finish_colors(Primitive& primitive) const {
  if (primitive.colors.empty()) return;
  primitive.colors.resize(primitive.positions.size(), glm::vec4(kNoColor));
  const float scale = largest_color_ > 1.0f ? 1.0f / 255.0f : 1.0f;
  for (glm::vec4& color : primitive.colors) {
    if (color.r == kNoColor)
      color = glm::vec4(1.0f);
    else
      for (int c = 0; c < 3; ++c) color[c] = srgb_decode(std::min(color[c] * scale, 1.0f));
    color.a = 1.0f;
  }
}

// Of some faces of a textured material; where all lack them, load_scene() says it.
void ObjReader::note_missing_texcoords() {
  for (const auto& [index, builder] : builders_) {
    if (index < 0 || !builder.has_texcoords || builder.line_without_texcoords == 0) continue;
    const Material& material = scene_.materials[static_cast<std::size_t>(index)];
    if (material.base_color_texture.texture >= 0 || material.emission_texture.texture >= 0)
      notes_.add("line " + std::to_string(builder.line_without_texcoords),
                 "a face of a textured material has no texture coordinates: taken as 0");
  }
}

void ObjReader::build_mesh() {
  Mesh mesh;
  for (auto& [material, builder] : builders_) {
    Primitive& primitive = builder.primitive;
    if (material < 0) {
      primitive.material = static_cast<int>(scene_.materials.size());
      scene_.materials.push_back(plain_material("no material"));
      if (!primitive.colors.empty()) scene_.materials.back().base_color = glm::vec4(1.0f);
    }
    if (!builder.has_texcoords) primitive.texcoords[0].clear();
    finish_colors(primitive);
    repair_normals(primitive);
    mesh.primitives.push_back(std::move(primitive));
  }
  if (mesh.primitives.empty()) throw InputError(path_, "has no faces that can be shown");
  scene_.meshes.push_back(std::move(mesh));
  Node node;
  node.mesh = 0;
  node.translation = base_;
  scene_.nodes.push_back(std::move(node));
}

Scene ObjReader::read() {
  const std::vector<std::uint8_t> bytes = files_.read(path_);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  base_ = find_base(text);
  LineReader lines(text);
  std::string_view line;
  while (lines.next(line)) {
    line_ = lines.line_number();
    std::string_view with_comment = lines.with_comment();
    const std::string_view key = take_word(line);
    take_word(with_comment);
    statement(key, line, with_comment);
  }
  if (triangulator_.unfinished() > 0) complain("concave polygons of too many corners: shown as fans");
  if (largest_color_ > 1.0f) complain("vertex colours above 1: taken as 0 to 255");
  note_missing_texcoords();
  notes_.log();
  build_mesh();
  return std::move(scene_);
}

}  // namespace

Scene import_obj(const std::string& path, const SceneFiles& files) {
  return ObjReader(path, files).read();
}

}  // namespace lightwell
