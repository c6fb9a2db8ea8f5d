// PLY importer: ASCII and binary of either byte order; vertices with positions, optional normals, texture coordinates
// and colours; faces as lists of any integer type, with texture coordinates, texture numbers and colours of their own;
// triangle strips. What else there is is left out with a warning.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "core/log.h"
#include "lightwell/error.h"
#include "lightwell/metrics.h"
#include "scene/file_notes.h"
#include "scene/geometry.h"
#include "scene/importers.h"
#include "scene/mtl.h"
#include "scene/ply_file.h"
#include "scene/polygon.h"
#include "scene/uri.h"

namespace lightwell {

namespace {

constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

bool is_finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

using Names = std::array<std::string_view, 4>;

// Which number each scalar property is, by `names`; the last place takes what is not needed.
template <std::size_t kCount>
struct Places {
  Places(const PlyElement& element, const std::array<Names, kCount>& names) {
    for (const PlyProperty& property : element.properties) {
      std::size_t place = 0;
      while (place < kCount &&
             (property.is_list || property.name.empty() ||
              std::find(names[place].begin(), names[place].end(), property.name) == names[place].end()))
        ++place;
      of_property.push_back(place);
      present[place] = true;
      if (property.type != PlyScalar::kFloat && property.type != PlyScalar::kDouble) is_integer[place] = true;
      if (property.type == PlyScalar::kUint16 || property.type == PlyScalar::kInt16) is_wide[place] = true;
    }
  }
  bool has(std::size_t first, std::size_t count) const {
    return std::all_of(present.begin() + static_cast<std::ptrdiff_t>(first),
                       present.begin() + static_cast<std::ptrdiff_t>(first + count), [](bool there) { return there; });
  }
  // The number that stands for the whole of a colour.
  float whole(std::size_t place) const { return !is_integer[place] ? 1.0f : is_wide[place] ? 65535.0f : 255.0f; }

  std::vector<std::size_t> of_property;
  std::array<bool, kCount + 1> present{};
  std::array<bool, kCount + 1> is_integer{};
  std::array<bool, kCount + 1> is_wide{};
};

constexpr Names kRed = {"red", "diffuse_red"}, kGreen = {"green", "diffuse_green"}, kBlue = {"blue", "diffuse_blue"},
                kAlpha = {"alpha", "diffuse_alpha"};

// Programs write what their screens show: sRGB. Alpha is linear.
template <std::size_t kCount>
glm::vec4 color_of(const Places<kCount>& places, const std::array<float, kCount + 1>& values, std::size_t first) {
  glm::vec4 color(1.0f);
  for (std::size_t c = 0; c < 3; ++c)
    color[static_cast<int>(c)] = srgb_decode(std::clamp(values[first + c] / places.whole(first + c), 0.0f, 1.0f));
  if (places.present[first + 3]) color.a = std::clamp(values[first + 3] / places.whole(first + 3), 0.0f, 1.0f);
  for (int c = 0; c < 4; ++c)
    if (std::isnan(color[c])) color[c] = 1.0f;
  return color;
}

// Faces and the triangles of strips as the file has them.
struct Polygons {
  std::vector<std::uint32_t> sizes;
  std::vector<std::uint32_t> corners;  // kNoVertex: an index that cannot be one
  std::vector<glm::vec2> texcoords;    // one a corner, NaN where its face has none; or empty
  std::vector<glm::vec4> colors;       // one a polygon, or none
  std::vector<int> textures;           // one a polygon, or none
};

class PlyReader {
 public:
  PlyReader(const std::string& path, const SceneFiles& files)
      : path_(path), files_(files), file_(path, files), notes_(path), textures_(scene_, path) {}
  Scene read();

 private:
  void read_vertices(const PlyElement& element);
  void read_faces(const PlyElement& element);
  void read_strips(const PlyElement& element);
  std::uint32_t take_index(const PlyProperty& property);
  void list_unread(const PlyElement& element, const std::vector<std::string_view>& read);
  bool is_shown(std::size_t polygon, std::size_t first_corner);
  void cut_polygons();
  void expand_corners();
  void build_primitives();
  int material_of(int texture);

  const std::string& path_;
  const SceneFiles& files_;
  PlyFile file_;
  FileNotes notes_;
  Scene scene_;
  TextureLoader textures_;
  glm::dvec3 base_{0.0};  // FarVertices
  Primitive primitive_;   // all vertices, less base_
  Polygons polygons_;
  // Of the triangles that are shown: three places in polygons_.corners each, and their polygon.
  std::vector<std::uint32_t> corners_;
  std::vector<std::uint32_t> polygon_of_;
  std::map<int, int> materials_;     // by texture number
  bool lets_light_through_ = false;  // some colour has an alpha below 1
};

bool is_indices(const PlyProperty& property) {
  return property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
}

void PlyReader::list_unread(const PlyElement& element, const std::vector<std::string_view>& read) {
  std::string names;
  for (const PlyProperty& property : element.properties)
    if (std::find(read.begin(), read.end(), property.name) == read.end() && names.size() < 200)
      names.append(names.empty() ? "" : ", ").append(property.name.substr(0, 40));
  if (!names.empty()) notes_.add("element '" + element.name.substr(0, 40) + "'", "not shown: " + names);
}

void PlyReader::read_vertices(const PlyElement& element) {
  constexpr std::size_t kCount = 12, kNormal = 3, kTexcoord = 6, kColor = 8;
  constexpr std::array<Names, kCount> kNames = {{{"x"},
                                                 {"y"},
                                                 {"z"},
                                                 {"nx"},
                                                 {"ny"},
                                                 {"nz"},
                                                 {"u", "s", "texture_u", "texcoord_u"},
                                                 {"v", "t", "texture_v", "texcoord_v"},
                                                 kRed,
                                                 kGreen,
                                                 kBlue,
                                                 kAlpha}};
  const Places<kCount> places(element, kNames);
  std::vector<std::string_view> read;
  for (std::size_t p = 0; p < places.of_property.size(); ++p)
    if (places.of_property[p] < kCount) read.push_back(element.properties[p].name);
  list_unread(element, read);
  if (!places.has(0, 3)) file_.fail("vertices have no x, y, z");
  const bool has_normals = places.has(kNormal, 3), has_texcoords = places.has(kTexcoord, 2);
  const bool has_colors = places.has(kColor, 3);

  std::array<float, kCount + 1> v{};
  std::array<double, kCount + 1> exact{};
  std::vector<glm::dvec3> positions;
  FarVertices far;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (std::size_t p = 0; p < places.of_property.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      for (std::uint64_t n = file_.take_size(property); n > 0; --n)
        exact[places.of_property[p]] = file_.scalar(property.type);
    }
    std::transform(exact.begin(), exact.end(), v.begin(), [](double x) { return static_cast<float>(x); });
    const std::string place = "vertex " + std::to_string(i);
    positions.emplace_back(exact[0], exact[1], exact[2]);
    far.add(positions.back());
    if (has_normals) {
      glm::vec3 normal(v[kNormal], v[kNormal + 1], v[kNormal + 2]);
      if (!is_finite(normal)) {
        notes_.add(place, "a normal that is no number: made from its faces");
        normal = glm::vec3(0.0f);
      }
      primitive_.normals.push_back(normal);
    }
    if (has_texcoords) {
      glm::vec2 uv(v[kTexcoord], 1.0f - v[kTexcoord + 1]);  // v points up in PLY
      if (!is_finite(glm::vec3(uv, 0.0f))) {
        notes_.add(place, "a texture coordinate that is no number: taken as 0");
        uv = glm::vec2(0.0f);
      }
      primitive_.texcoords[0].push_back(uv);
    }
    if (has_colors) primitive_.colors.push_back(color_of(places, v, kColor));
    lets_light_through_ = lets_light_through_ || (has_colors && primitive_.colors.back().a < 1.0f);
  }
  base_ = far.base();
  primitive_.positions.reserve(positions.size());
  for (const glm::dvec3& position : positions) primitive_.positions.emplace_back(position - base_);
}

std::uint32_t PlyReader::take_index(const PlyProperty& property) {
  const double index = file_.scalar(property.type);
  const bool possible = index >= 0.0 && index < kNoVertex && index == std::floor(index);
  return possible ? static_cast<std::uint32_t>(index) : kNoVertex;
}

void PlyReader::read_faces(const PlyElement& element) {
  constexpr std::size_t kCount = 5, kColor = 0, kTexture = 4;
  constexpr std::array<Names, kCount> kNames = {{kRed, kGreen, kBlue, kAlpha, {"texnumber"}}};
  const Places<kCount> places(element, kNames);
  const auto is_texcoords = [](const PlyProperty& property) { return property.is_list && property.name == "texcoord"; };
  std::vector<std::string_view> read;
  bool has_texcoords = false;
  for (std::size_t p = 0; p < places.of_property.size(); ++p) {
    const PlyProperty& property = element.properties[p];
    has_texcoords = has_texcoords || is_texcoords(property);
    if (places.of_property[p] < kCount || is_indices(property) || is_texcoords(property)) read.push_back(property.name);
  }
  list_unread(element, read);
  const bool has_colors = places.has(kColor, 3), has_textures = places.present[kTexture];

  std::array<float, kCount + 1> values{};
  std::vector<float> texcoords;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    const std::size_t first = polygons_.corners.size();
    texcoords.clear();
    for (std::size_t p = 0; p < places.of_property.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      for (std::uint64_t n = file_.take_size(property); n > 0; --n) {
        if (is_indices(property))
          polygons_.corners.push_back(take_index(property));
        else if (is_texcoords(property))
          texcoords.push_back(static_cast<float>(file_.scalar(property.type)));
        else
          values[places.of_property[p]] = static_cast<float>(file_.scalar(property.type));
      }
    }
    const std::size_t size = polygons_.corners.size() - first;
    polygons_.sizes.push_back(static_cast<std::uint32_t>(size));
    if (has_texcoords) {
      constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
      const bool complete = texcoords.size() == 2 * size;
      if (!complete && !texcoords.empty())
        notes_.add("face " + std::to_string(i), "not two texture coordinates a corner: left out");
      for (std::size_t k = 0; k < size; ++k) {
        const glm::vec2 uv = complete ? glm::vec2(texcoords[2 * k], 1.0f - texcoords[2 * k + 1]) : glm::vec2(kNone);
        polygons_.texcoords.push_back(is_finite(glm::vec3(uv, 0.0f)) ? uv : glm::vec2(kNone));
      }
    }
    if (has_colors) polygons_.colors.push_back(color_of(places, values, kColor));
    lets_light_through_ = lets_light_through_ || (has_colors && polygons_.colors.back().a < 1.0f);
    if (has_textures) {
      const float number = values[kTexture];
      const bool known = number >= 0.0f && number < static_cast<float>(file_.texture_files().size());
      if (!known) notes_.add("face " + std::to_string(i), "a texture number that is none of the file's: left out");
      polygons_.textures.push_back(known ? static_cast<int>(number) : -1);
    }
  }
}

// Lists of any length; -1 ends a strip and begins another.
void PlyReader::read_strips(const PlyElement& element) {
  std::vector<std::uint32_t> strip;
  const auto finish = [&] {
    const std::vector<std::uint32_t> triangles = triangles_of_strip(strip);
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
      // Strips are joined by triangles without area.
      if (triangles[i] == triangles[i + 1] || triangles[i + 1] == triangles[i + 2] || triangles[i] == triangles[i + 2])
        continue;
      polygons_.sizes.push_back(3);
      polygons_.corners.insert(polygons_.corners.end(), {triangles[i], triangles[i + 1], triangles[i + 2]});
    }
    strip.clear();
  };
  list_unread(element, {"vertex_indices", "vertex_index"});
  for (std::uint64_t i = 0; i < element.count; ++i)
    for (const PlyProperty& property : element.properties) {
      for (std::uint64_t n = file_.take_size(property); n > 0; --n) {
        const std::uint32_t index = take_index(property);
        if (!is_indices(property)) continue;
        if (index == kNoVertex)
          finish();
        else
          strip.push_back(index);
      }
      finish();
    }
}

bool PlyReader::is_shown(std::size_t polygon, std::size_t first_corner) {
  const std::string place = "face " + std::to_string(polygon);
  if (polygons_.sizes[polygon] < 3) {
    notes_.add(place, "a face of fewer than three vertices: left out");
    return false;
  }
  for (std::size_t k = 0; k < polygons_.sizes[polygon]; ++k) {
    const std::uint32_t vertex = polygons_.corners[first_corner + k];
    if (vertex < primitive_.positions.size() && is_finite(primitive_.positions[vertex])) continue;
    notes_.add(place, vertex < primitive_.positions.size() ? "a face has a vertex that is no number: left out"
                                                           : "a face has a vertex that the file lacks: left out");
    return false;
  }
  return true;
}

void PlyReader::cut_polygons() {
  Triangulator triangulator;
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> triangles;
  std::size_t first = 0;
  for (std::size_t polygon = 0; polygon < polygons_.sizes.size(); first += polygons_.sizes[polygon], ++polygon) {
    if (!is_shown(polygon, first)) continue;
    positions.clear();
    triangles.clear();
    for (std::size_t k = 0; k < polygons_.sizes[polygon]; ++k)
      positions.push_back(primitive_.positions[polygons_.corners[first + k]]);
    triangulator.triangulate(positions, triangles);
    for (const std::uint32_t corner : triangles) corners_.push_back(static_cast<std::uint32_t>(first) + corner);
    polygon_of_.resize(corners_.size() / 3, static_cast<std::uint32_t>(polygon));
  }
  if (triangulator.unfinished() > 0) notes_.add("faces", "concave polygons of too many corners: shown as fans");
}

// Gives each corner a vertex of its own where faces have attributes that vertices have not.
void PlyReader::expand_corners() {
  primitive_.indices.reserve(corners_.size());
  for (const std::uint32_t corner : corners_) primitive_.indices.push_back(polygons_.corners[corner]);
  const bool own_texcoords = polygons_.texcoords.size() == polygons_.corners.size() &&
                             std::any_of(polygons_.texcoords.begin(), polygons_.texcoords.end(),
                                         [](const glm::vec2& uv) { return !std::isnan(uv.x); });
  const bool own_colors = polygons_.colors.size() == polygons_.sizes.size() && !polygons_.colors.empty();
  if (!own_texcoords && !own_colors) return;
  primitive_ = with_own_vertices(primitive_, primitive_.indices);
  if (own_texcoords) {
    primitive_.texcoords[0].resize(corners_.size(), glm::vec2(0.0f));
    for (std::size_t i = 0; i < corners_.size(); ++i)
      if (!std::isnan(polygons_.texcoords[corners_[i]].x))
        primitive_.texcoords[0][i] = polygons_.texcoords[corners_[i]];
  }
  if (own_colors) {
    primitive_.colors.clear();
    for (std::size_t i = 0; i < corners_.size(); ++i) primitive_.colors.push_back(polygons_.colors[polygon_of_[i / 3]]);
  }
}

int PlyReader::material_of(int texture) {
  const auto [entry, is_new] = materials_.try_emplace(texture, static_cast<int>(scene_.materials.size()));
  if (!is_new) return entry->second;
  Material& material = scene_.materials.emplace_back(plain_material("surface"));
  if (!primitive_.colors.empty()) material.base_color = glm::vec4(1.0f);
  if (lets_light_through_) {
    material.alpha_mode = AlphaMode::kBlend;
    notes_.add("colours", "let light through (alpha): shown as if they were not there below 0.5, else solid");
  }
  const std::vector<std::string>& names = file_.texture_files();
  if (texture < 0 || static_cast<std::size_t>(texture) >= names.size()) return entry->second;
  const std::string& name = names[static_cast<std::size_t>(texture)];
  if (const std::optional<std::string> file = files_.find_file(path_, name))
    material.base_color_texture.texture = textures_.add_file(files_, *file, name);
  else
    log_warning(resolve_name(path_, name) + ": texture not found, used by " + path_);
  if (material.base_color_texture.texture >= 0) material.base_color = glm::vec4(1.0f);
  return entry->second;
}

// One primitive a texture.
void PlyReader::build_primitives() {
  const bool has_texcoords = !primitive_.texcoords[0].empty();
  if (!has_texcoords && !file_.texture_files().empty())
    notes_.add("TextureFile", "a texture without texture coordinates: left out");
  std::map<int, std::vector<std::uint32_t>> indices;  // by texture number
  const bool numbered = polygons_.textures.size() == polygons_.sizes.size() && !polygons_.textures.empty();
  for (std::size_t i = 0; i < primitive_.indices.size(); ++i)
    indices[!has_texcoords ? -1
            : numbered     ? polygons_.textures[polygon_of_[i / 3]]
                           : 0]
        .push_back(primitive_.indices[i]);

  // Vertices that no face may use stand where they change no bounds.
  const glm::vec3 somewhere = primitive_.positions[primitive_.indices[0]];
  for (glm::vec3& position : primitive_.positions)
    if (!is_finite(position)) position = somewhere;
  Mesh& mesh = scene_.meshes.emplace_back();
  for (auto& [texture, own] : indices) {
    const int material = material_of(texture);  // before the vertices are gone
    Primitive part = indices.size() > 1 ? with_own_vertices(primitive_, own) : std::move(primitive_);
    part.material = material;
    if (part.normals.empty())
      make_flat(part);
    else
      repair_normals(part);
    mesh.primitives.push_back(std::move(part));
  }
  Node& node = scene_.nodes.emplace_back();
  node.mesh = 0;
  node.translation = base_;
}

Scene PlyReader::read() {
  for (const PlyElement& element : file_.elements()) {
    file_.check_count(element);
    if (element.name == "vertex" && primitive_.positions.empty()) {
      read_vertices(element);
    } else if (element.name == "face") {
      read_faces(element);
    } else if (element.name == "tristrips") {
      read_strips(element);
    } else {
      if (element.count > 0) notes_.add("element '" + element.name.substr(0, 40) + "'", "is not shown");
      file_.skip(element);
    }
  }
  if (polygons_.sizes.empty())
    file_.fail(primitive_.positions.empty() ? "has no faces"
                                            : "is a point cloud: " + std::to_string(primitive_.positions.size()) +
                                                  " points and no faces, so no surface to show");
  cut_polygons();
  if (!corners_.empty()) {
    expand_corners();
    build_primitives();
  }
  notes_.log();
  if (corners_.empty()) file_.fail("has no faces that can be shown");
  return std::move(scene_);
}

}  // namespace

Scene import_ply(const std::string& path, const SceneFiles& files) {
  return PlyReader(path, files).read();
}

}  // namespace lightwell
