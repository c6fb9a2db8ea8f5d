// Wavefront OBJ importer: one mesh, one primitive a material. Faces without normals are flat.
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

#include "core/log.h"
#include "lightwell/error.h"
#include "scene/geometry.h"
#include "scene/importers.h"
#include "scene/mtl.h"
#include "scene/text_scanner.h"
#include "scene/uri.h"

namespace lightwell {

namespace {

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
};

class ObjReader {
 public:
  ObjReader(const std::string& path, const SceneFiles& files)
      : path_(path), files_(files), materials_{path, files, scene_, TextureLoader(scene_, path), {}} {}
  Scene read();

 private:
  void statement(std::string_view key, std::string_view rest);
  template <typename T>
  T vector(std::string_view rest) const;
  int resolve(std::string_view word, std::size_t count, const char* what) const;
  Corner parse_corner(std::string_view word) const;
  void add_face(std::string_view rest);
  glm::vec3 face_normal() const;
  std::uint32_t add_vertex(PrimitiveBuilder& builder, const Corner& corner, const glm::vec3& normal);
  PrimitiveBuilder& builder();
  void use_material(std::string_view name);
  void use_libraries(std::string_view names);
  void build_mesh();
  [[noreturn]] void fail(const std::string& cause) const {
    throw InputError(path_, "line " + std::to_string(line_) + ": " + cause);
  }

  const std::string& path_;
  const SceneFiles& files_;
  Scene scene_;
  MtlMaterials materials_;
  std::vector<glm::vec3> positions_;
  std::vector<glm::vec2> texcoords_;
  std::vector<glm::vec3> normals_;
  std::set<std::string> libraries_;
  std::map<int, PrimitiveBuilder> builders_;  // by material
  PrimitiveBuilder* builder_ = nullptr;       // of the current material, once it has a face
  int material_ = -1;
  std::vector<Corner> face_;
  long line_ = 0;
  bool warned_of_material_ = false;
};

template <typename T>
T ObjReader::vector(std::string_view rest) const {
  T value(0.0f);
  for (int i = 0; i < T::length(); ++i) {
    const std::string_view word = take_word(rest);
    const bool optional = T::length() == 2 && i == 1;  // a texture coordinate may have only u
    if (word.empty() && optional) break;
    const std::optional<float> number = parse_float(word);
    if (!number) fail("expected " + std::to_string(T::length()) + " numbers");
    value[i] = *number;
  }
  return value;
}

// Positive numbers count from 1, negative ones back from the latest entry.
int ObjReader::resolve(std::string_view word, std::size_t count, const char* what) const {
  const std::optional<std::int64_t> number = parse_integer(word);
  if (!number) fail("malformed face");
  const auto size = static_cast<std::int64_t>(count);
  const std::int64_t index = *number > 0 ? *number - 1 : *number < -size ? -1 : size + *number;
  if (*number == 0 || index < 0 || index >= size)
    fail(std::string(what) + " " + std::to_string(*number) + " of " + std::to_string(size));
  return static_cast<int>(index);
}

// v, v/vt, v//vn or v/vt/vn.
Corner ObjReader::parse_corner(std::string_view word) const {
  std::array<std::string_view, 3> parts;
  for (std::string_view& part : parts) {
    const std::size_t slash = std::min(word.find('/'), word.size());
    part = word.substr(0, slash);
    word.remove_prefix(std::min(slash + 1, word.size()));
  }
  if (!word.empty()) fail("malformed face");
  Corner corner;
  corner.position = resolve(parts[0], positions_.size(), "vertex");
  if (!parts[1].empty()) corner.texcoord = resolve(parts[1], texcoords_.size(), "texture coordinate");
  if (!parts[2].empty()) corner.normal = resolve(parts[2], normals_.size(), "normal");
  return corner;
}

// Of a polygon, also a bent one: the sum of its fan's area vectors (Newell's method).
glm::vec3 ObjReader::face_normal() const {
  const auto corner = [&](std::size_t i) {
    return glm::dvec3(positions_[static_cast<std::size_t>(face_[i].position)]);
  };
  glm::dvec3 sum(0.0);
  for (std::size_t i = 1; i + 1 < face_.size(); ++i)
    sum += glm::cross(corner(i) - corner(0), corner(i + 1) - corner(0));
  const double length = glm::length(sum);
  return length > 0.0 && std::isfinite(length) ? glm::vec3(sum / length) : glm::vec3(0.0f, 0.0f, 1.0f);
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
  primitive.positions.push_back(positions_[static_cast<std::size_t>(corner.position)]);
  primitive.normals.push_back(corner.normal < 0 ? normal : normals_[static_cast<std::size_t>(corner.normal)]);
  primitive.texcoords[0].push_back(corner.texcoord < 0 ? glm::vec2(0.0f)
                                                       : texcoords_[static_cast<std::size_t>(corner.texcoord)]);
  builder.has_texcoords = builder.has_texcoords || corner.texcoord >= 0;
  return index;
}

void ObjReader::add_face(std::string_view rest) {
  face_.clear();
  for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest))
    face_.push_back(parse_corner(word));
  if (face_.size() < 3) fail("a face needs three vertices");
  const glm::vec3 normal = face_normal();
  PrimitiveBuilder& target = builder();
  std::vector<std::uint32_t> fan;
  for (const Corner& corner : face_) fan.push_back(add_vertex(target, corner, normal));
  for (std::size_t i = 1; i + 1 < fan.size(); ++i)
    target.primitive.indices.insert(target.primitive.indices.end(), {fan[0], fan[i], fan[i + 1]});
}

void ObjReader::use_material(std::string_view name) {
  const auto found = materials_.indices.find(std::string(name));
  builder_ = nullptr;
  material_ = found == materials_.indices.end() ? -1 : found->second;
  if (material_ < 0 && !warned_of_material_) {
    log_warning(path_ + ": material '" + std::string(name.substr(0, 80)) + "' is not defined");
    warned_of_material_ = true;
  }
}

// One name that may hold spaces, or several names.
void ObjReader::use_libraries(std::string_view names) {
  std::vector<std::string> files = {resolve_name(path_, std::string(trimmed(names)))};
  if (!files_.exists(files[0])) {
    files.clear();
    for (std::string_view name = take_word(names); !name.empty(); name = take_word(names))
      files.push_back(resolve_name(path_, std::string(name)));
  }
  for (const std::string& file : files)
    if (libraries_.insert(file).second) read_mtl(file, materials_);
}

void ObjReader::statement(std::string_view key, std::string_view rest) {
  if (key == "v") {
    positions_.push_back(vector<glm::vec3>(rest));
  } else if (key == "vn") {
    normals_.push_back(vector<glm::vec3>(rest));
  } else if (key == "vt") {
    const auto uv = vector<glm::vec2>(rest);
    texcoords_.push_back({uv.x, 1.0f - uv.y});  // v points up in OBJ
  } else if (key == "f") {
    add_face(rest);
  } else if (key == "usemtl") {
    use_material(trimmed(rest));
  } else if (key == "mtllib") {
    use_libraries(rest);
  }
}

void ObjReader::build_mesh() {
  Mesh mesh;
  for (auto& [material, builder] : builders_) {
    Primitive& primitive = builder.primitive;
    if (material < 0) {
      primitive.material = static_cast<int>(scene_.materials.size());
      scene_.materials.push_back(plain_material("no material"));
    }
    if (!builder.has_texcoords) primitive.texcoords[0].clear();
    repair_normals(primitive);
    mesh.primitives.push_back(std::move(primitive));
  }
  if (mesh.primitives.empty()) throw InputError(path_, "has no faces");
  scene_.meshes.push_back(std::move(mesh));
  Node node;
  node.mesh = 0;
  scene_.nodes.push_back(std::move(node));
}

Scene ObjReader::read() {
  const std::vector<std::uint8_t> bytes = files_.read(path_);
  LineReader lines({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  std::string_view line;
  while (lines.next(line)) {
    line_ = lines.line_number();
    const std::string_view key = take_word(line);
    statement(key, line);
  }
  build_mesh();
  return std::move(scene_);
}

}  // namespace

Scene import_obj(const std::string& path, const SceneFiles& files) {
  return ObjReader(path, files).read();
}

}  // namespace lightwell
