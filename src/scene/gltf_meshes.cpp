#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>

#include "scene/geometry.h"
#include "scene/gltf_accessor.h"
#include "scene/gltf_compressed.h"
#include "scene/gltf_parts.h"
#include "scene/gltf_repair.h"

namespace lightwell {

namespace {

enum Mode : std::uint64_t {
  kPoints,
  kLines,
  kLineLoop,
  kLineStrip,
  kTriangles,
  kTriangleStrip,
  kTriangleFan,
  kModeCount
};

constexpr std::array<const char*, kTexcoordSets> kTexcoordNames = {"TEXCOORD_0", "TEXCOORD_1", "TEXCOORD_2",
                                                                   "TEXCOORD_3"};

class MeshReader {
 public:
  MeshReader(GltfFile& file, std::size_t material_count) : file_(file), material_count_(material_count) {}

  Mesh read(const JsonView& json);

 private:
  // False: nothing to show (points, lines, no positions).
  bool read_primitive(const JsonView& json, Primitive& primitive);
  std::vector<std::uint32_t> read_indices(const JsonView& json, std::uint64_t mode, std::size_t vertex_count);
  void read_skinning(const JsonView& attributes, Primitive& primitive);
  void add_influences(const JsonView& joints, const JsonView& weights, Primitive& primitive);
  void read_morph_targets(const JsonView& targets, Primitive& primitive);
  void finish_normals(Primitive& primitive);
  void match_weights(const JsonView& json, Mesh& mesh);

  // An attribute, which must have `count` entries; empty if absent. What is not finite becomes 0, with a warning.
  template <typename T>
  std::vector<T> read_attribute(const JsonView& reference, std::size_t count) {
    if (!reference.present()) return {};
    std::vector<T> values = GltfAccessor(file_, reference).vectors<T>();
    if (values.size() != count) reference.fail("has another count than POSITION");
    replace_not_finite(file_, reference, values, T(0.0f), "holds numbers that are not finite: taken as 0");
    return values;
  }
  std::vector<glm::vec4> read_colors(const JsonView& reference, std::size_t count);
  void leave_out_bad_vertices(const JsonView& reference, Primitive& primitive);

  GltfFile& file_;
  std::size_t material_count_;
};

std::vector<std::uint32_t> MeshReader::read_indices(const JsonView& json, std::uint64_t mode,
                                                    std::size_t vertex_count) {
  std::vector<std::uint32_t> indices;
  const JsonView reference = json["indices"];
  if (reference.present()) {
    const GltfAccessor accessor(file_, reference);
    accessor.expect_components(1);
    indices = accessor.unsigned_integers();
    for (const std::uint32_t i : indices)
      if (i >= vertex_count)
        reference.fail("vertex index " + std::to_string(i) + " of " + std::to_string(vertex_count));
  } else {
    file_.budget().charge(vertex_count, sizeof(std::uint32_t));
    indices.resize(vertex_count);
    std::iota(indices.begin(), indices.end(), 0u);
  }
  if (mode != kTriangles) {
    file_.budget().charge(indices.size(), 3 * sizeof(std::uint32_t));
    return mode == kTriangleStrip ? triangles_of_strip(indices) : triangles_of_fan(indices);
  }
  if (indices.size() % 3 != 0) {
    file_.note(json, "its list of triangles ends in an incomplete one: left out");
    indices.resize(indices.size() / 3 * 3);
  }
  return indices;
}

// Keeps the influence if it is one of the four largest.
void add_influence(std::uint16_t joint, float weight, glm::u16vec4& joints, glm::vec4& weights) {
  int smallest = 0;
  for (int k = 1; k < 4; ++k)
    if (weights[k] < weights[smallest]) smallest = k;
  if (!(weight > weights[smallest])) return;
  joints[smallest] = joint;
  weights[smallest] = weight;
}

void MeshReader::add_influences(const JsonView& joints, const JsonView& weights, Primitive& primitive) {
  const std::size_t count = primitive.positions.size();
  const GltfAccessor accessor(file_, joints);
  accessor.expect_components(4);
  const std::vector<std::uint32_t> indices = accessor.unsigned_integers();
  if (indices.size() != count * 4) joints.fail("has another count than POSITION");
  const std::vector<glm::vec4> all = read_attribute<glm::vec4>(weights, count);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] > 0xffff) joints.fail("joint index is too large");
    const std::size_t v = i / 4;
    add_influence(static_cast<std::uint16_t>(indices[i]), all[v][static_cast<int>(i % 4)], primitive.joints[v],
                  primitive.weights[v]);
  }
}

// COLOR_0: linear, three or four numbers a vertex. Integers are parts of their maximum, whether the file says so or
// not.
std::vector<glm::vec4> MeshReader::read_colors(const JsonView& reference, std::size_t count) {
  if (!reference.present()) return {};
  GltfAccessor accessor(file_, reference);
  accessor.normalize_integers();
  const auto width = static_cast<std::size_t>(accessor.components());
  if (width != 3 && width != 4) reference.fail("is neither VEC3 nor VEC4");
  if (accessor.count() != count) reference.fail("has another count than POSITION");
  const std::vector<float> numbers = accessor.floats();
  file_.budget().charge(count, sizeof(glm::vec4));
  std::vector<glm::vec4> colors(count, glm::vec4(1.0f));
  std::size_t mended = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const float given = numbers[i];
    float& number = colors[i / width][static_cast<int>(i % width)];
    if (std::isfinite(given)) number = std::clamp(given, 0.0f, 1.0f);
    if (number != given) ++mended;
  }
  if (mended > 0) file_.note(reference, "holds numbers that are not in 0 to 1: brought there", mended);
  return colors;
}

// Triangles with a vertex that is nowhere cannot be shown.
void MeshReader::leave_out_bad_vertices(const JsonView& reference, Primitive& primitive) {
  std::vector<glm::vec3>& positions = primitive.positions;
  std::vector<std::uint32_t>& indices = primitive.indices;
  if (std::all_of(positions.begin(), positions.end(), is_finite_value<glm::vec3>)) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const auto is_good = [&](std::uint32_t v) { return is_finite_value(positions[v]); };
    if (!is_good(indices[i]) || !is_good(indices[i + 1]) || !is_good(indices[i + 2])) continue;
    std::copy_n(indices.begin() + static_cast<std::ptrdiff_t>(i), 3,
                indices.begin() + static_cast<std::ptrdiff_t>(kept));
    kept += 3;
  }
  file_.note(reference, "holds numbers that are not finite: triangles at such vertices are left out",
             (indices.size() - kept) / 3);
  indices.resize(kept);
  for (glm::vec3& position : positions)
    if (!is_finite_value(position)) position = glm::vec3(0.0f);
}

void MeshReader::read_skinning(const JsonView& attributes, Primitive& primitive) {
  for (int set = 0; true; ++set) {
    const JsonView joints = attributes[("JOINTS_" + std::to_string(set)).c_str()];
    const JsonView weights = attributes[("WEIGHTS_" + std::to_string(set)).c_str()];
    if (!joints.present() || !weights.present()) break;
    if (set == 0) {
      file_.budget().charge(primitive.positions.size(), sizeof(glm::u16vec4) + sizeof(glm::vec4));
      primitive.joints.assign(primitive.positions.size(), glm::u16vec4(0));
      primitive.weights.assign(primitive.positions.size(), glm::vec4(0.0f));
    }
    add_influences(joints, weights, primitive);
  }
  for (glm::vec4& w : primitive.weights) {
    const float sum = w.x + w.y + w.z + w.w;
    w = sum > 0.0f && std::isfinite(sum) ? w / sum : glm::vec4(1.0f, 0.0f, 0.0f, 0.0f);
  }
}

void MeshReader::read_morph_targets(const JsonView& targets, Primitive& primitive) {
  for (std::size_t i = 0; i < targets.size(); ++i) {
    MorphTarget target;
    target.positions = read_attribute<glm::vec3>(targets[i]["POSITION"], primitive.positions.size());
    target.normals = read_attribute<glm::vec3>(targets[i]["NORMAL"], primitive.positions.size());
    primitive.morph_targets.push_back(std::move(target));
  }
}

void MeshReader::finish_normals(Primitive& primitive) {
  if (!primitive.normals.empty()) return repair_normals(primitive);
  std::uint64_t bytes_a_vertex = 2 * sizeof(glm::vec3);
  if (!primitive.colors.empty()) bytes_a_vertex += sizeof(glm::vec4);
  for (const auto& texcoords : primitive.texcoords) bytes_a_vertex += texcoords.empty() ? 0 : sizeof(glm::vec2);
  if (!primitive.joints.empty()) bytes_a_vertex += sizeof(glm::u16vec4) + sizeof(glm::vec4);
  bytes_a_vertex += primitive.morph_targets.size() * 2 * sizeof(glm::vec3);
  file_.budget().charge(primitive.indices.size(), bytes_a_vertex);
  make_flat(primitive);
}

bool MeshReader::read_primitive(const JsonView& json, Primitive& primitive) {
  const std::uint64_t mode = json["mode"].count(kTriangles);
  if (mode >= kModeCount) json.fail("unknown mode " + std::to_string(mode));
  const JsonView attributes = json["attributes"];
  primitive.material = json["material"].index(material_count_);
  if (mode < kTriangles || !attributes["POSITION"].present()) {
    file_.note(json, mode < kTriangles ? "is a set of points or lines: left out" : "has no positions: left out");
    return false;
  }
  decode_draco(file_, json);
  primitive.positions = GltfAccessor(file_, attributes["POSITION"]).vectors<glm::vec3>();
  const std::size_t count = primitive.positions.size();
  primitive.indices = read_indices(json, mode, count);
  leave_out_bad_vertices(attributes["POSITION"], primitive);
  primitive.normals = read_attribute<glm::vec3>(attributes["NORMAL"], count);
  for (std::size_t set = 0; set < kTexcoordSets; ++set)
    primitive.texcoords[set] = read_attribute<glm::vec2>(attributes[kTexcoordNames[set]], count);
  primitive.colors = read_colors(attributes["COLOR_0"], count);
  read_skinning(attributes, primitive);
  read_morph_targets(json["targets"], primitive);
  finish_normals(primitive);
  return true;
}

// All primitives of a mesh have as many morph targets as it has weights.
void MeshReader::match_weights(const JsonView& json, Mesh& mesh) {
  std::size_t targets = 0;
  for (const Primitive& primitive : mesh.primitives) targets = std::max(targets, primitive.morph_targets.size());
  if (!mesh.morph_weights.empty() && mesh.morph_weights.size() != targets)
    file_.note(json["weights"], "are not one weight a morph target: cut, or filled with 0");
  mesh.morph_weights.resize(targets, 0.0f);
  for (Primitive& primitive : mesh.primitives) {
    if (primitive.morph_targets.size() != targets)
      file_.note(json, "its primitives differ in morph targets: those without stay as they are");
    primitive.morph_targets.resize(targets);
  }
}

Mesh MeshReader::read(const JsonView& json) {
  Mesh mesh;
  mesh.name = read_name(file_, json["name"]);
  mesh.morph_weights = read_number_list(file_, json["weights"]);
  const JsonView primitives = json["primitives"];
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    Primitive primitive;
    if (read_primitive(primitives[i], primitive)) mesh.primitives.push_back(std::move(primitive));
  }
  match_weights(json, mesh);
  return mesh;
}

}  // namespace

void read_gltf_meshes(GltfFile& file, Scene& scene) {
  MeshReader reader(file, scene.materials.size());
  const JsonView meshes = file.root()["meshes"];
  for (std::size_t i = 0; i < meshes.size(); ++i) scene.meshes.push_back(reader.read(meshes[i]));
}

}  // namespace lightwell
