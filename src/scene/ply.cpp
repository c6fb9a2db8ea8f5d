// PLY importer: ASCII and binary of either byte order; one mesh, one primitive a texture.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/log.h"
#include "lightwell/error.h"
#include "scene/file_notes.h"
#include "scene/geometry.h"
#include "scene/importers.h"
#include "scene/mtl.h"
#include "scene/ply_contents.h"
#include "scene/ply_file.h"
#include "scene/polygon.h"
#include "scene/uri.h"

namespace lightwell {

namespace {

bool is_finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

class PlyReader {
 public:
  PlyReader(const std::string& path, const SceneFiles& files)
      : path_(path), files_(files), file_(path, files), notes_(path), textures_(scene_, path) {}
  Scene read();

 private:
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
  PlyContents contents_;
  Primitive& primitive_ = contents_.vertices;
  const PlyPolygons& polygons_ = contents_.polygons;
  // Of the triangles that are shown: three places in polygons_.corners each, and their polygon.
  std::vector<std::uint32_t> corners_;
  std::vector<std::uint32_t> polygon_of_;
  std::map<int, int> materials_;  // by texture number
};

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
  if (contents_.lets_light_through) {
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
  node.translation = contents_.base;
}

Scene PlyReader::read() {
  contents_ = read_ply_contents(file_, notes_);
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
