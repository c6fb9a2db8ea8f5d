#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>

#include "core/log.h"
#include "scene/geometry.h"
#include "scene/gltf_accessor.h"
#include "scene/gltf_parts.h"

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

class MeshReader {
 public:
  MeshReader(GltfFile& file, std::size_t material_count) : file_(file), material_count_(material_count) {}

  Mesh read(const JsonView& json);
  void warn_of_what_was_left_out() const;

 private:
  // False: nothing to show (points, lines, no positions).
  bool read_primitive(const JsonView& json, Primitive& primitive);
  std::vector<std::uint32_t> read_indices(const JsonView& json, std::uint64_t mode, std::size_t vertex_count);
  void read_skinning(const JsonView& attributes, Primitive& primitive);
  void add_influences(const JsonView& joints, const JsonView& weights, Primitive& primitive);
  void read_morph_targets(const JsonView& targets, Primitive& primitive);
  void finish_normals(Primitive& primitive);

  // An attribute, which must have `count` entries; empty if absent.
  template <typename T>
  std::vector<T> read_attribute(const JsonView& reference, std::size_t count) {
    if (!reference.present()) return {};
    std::vector<T> values = GltfAccessor(file_, reference).vectors<T>();
    if (values.size() != count) reference.fail("has another count than POSITION");
    return values;
  }

  GltfFile& file_;
  std::size_t material_count_;
  long left_out_ = 0;
  long cut_ = 0;
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
    ++cut_;
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
    ++left_out_;
    return false;
  }
  primitive.positions = GltfAccessor(file_, attributes["POSITION"]).vectors<glm::vec3>();
  const std::size_t count = primitive.positions.size();
  primitive.indices = read_indices(json, mode, count);
  primitive.normals = read_attribute<glm::vec3>(attributes["NORMAL"], count);
  primitive.texcoords[0] = read_attribute<glm::vec2>(attributes["TEXCOORD_0"], count);
  primitive.texcoords[1] = read_attribute<glm::vec2>(attributes["TEXCOORD_1"], count);
  read_skinning(attributes, primitive);
  read_morph_targets(json["targets"], primitive);
  finish_normals(primitive);
  return true;
}

Mesh MeshReader::read(const JsonView& json) {
  Mesh mesh;
  mesh.name = json["name"].string("");
  mesh.morph_weights = json["weights"].numbers();
  const JsonView primitives = json["primitives"];
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    Primitive primitive;
    if (!read_primitive(primitives[i], primitive)) continue;
    if (mesh.morph_weights.empty()) mesh.morph_weights.resize(primitive.morph_targets.size(), 0.0f);
    if (primitive.morph_targets.size() != mesh.morph_weights.size())
      primitives[i].fail("number of morph targets differs from the mesh's weights");
    mesh.primitives.push_back(std::move(primitive));
  }
  return mesh;
}

void MeshReader::warn_of_what_was_left_out() const {
  if (left_out_ > 0)
    log_warning(file_.path() + ": left out " + std::to_string(left_out_) + " sets of points, lines or nothing");
  if (cut_ > 0)
    log_warning(file_.path() + ": " + std::to_string(cut_) + " triangle lists end in an incomplete triangle");
}

}  // namespace

void read_gltf_meshes(GltfFile& file, Scene& scene) {
  MeshReader reader(file, scene.materials.size());
  const JsonView meshes = file.root()["meshes"];
  for (std::size_t i = 0; i < meshes.size(); ++i) scene.meshes.push_back(reader.read(meshes[i]));
  reader.warn_of_what_was_left_out();
}

}  // namespace lightwell
