#include <cmath>
#include <iterator>
#include <utility>

#include <glm/ext/vector_double4.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "scene/gltf_accessor.h"
#include "scene/gltf_parts.h"
#include "scene/gltf_repair.h"

namespace lightwell {

namespace {

// The file's tree, with indices checked: every node has at most one parent, and following parents ends.
class NodeTree {
 public:
  explicit NodeTree(const JsonView& nodes) : nodes_(nodes), children_(nodes.size()), parent_(nodes.size(), -1) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      children_[i] = nodes[i]["children"].indices(nodes.size());
      for (const int child : children_[i]) {
        int& parent = parent_[static_cast<std::size_t>(child)];
        if (parent >= 0) nodes[i].fail("child node " + std::to_string(child) + " has two parents");
        parent = static_cast<int>(i);
      }
    }
  }

  int parent(int node) const { return parent_[static_cast<std::size_t>(node)]; }

  // All nodes, each after its parent, siblings in file order.
  std::vector<int> parents_first() const {
    std::vector<int> order;
    std::vector<int> stack;
    for (std::size_t root = parent_.size(); root-- > 0;)
      if (parent_[root] < 0) stack.push_back(static_cast<int>(root));
    while (!stack.empty()) {
      const int node = stack.back();
      stack.pop_back();
      order.push_back(node);
      const std::vector<int>& children = children_[static_cast<std::size_t>(node)];
      stack.insert(stack.end(), children.rbegin(), children.rend());
    }
    if (order.size() != parent_.size()) nodes_.fail("the node tree has a cycle");
    return order;
  }

  // Which nodes hang below `roots`.
  std::vector<bool> reachable(const std::vector<int>& roots) const {
    std::vector<bool> reached(parent_.size(), false);
    std::vector<int> stack = roots;
    while (!stack.empty()) {
      const auto node = static_cast<std::size_t>(stack.back());
      stack.pop_back();
      if (reached[node]) continue;
      reached[node] = true;
      stack.insert(stack.end(), children_[node].begin(), children_[node].end());
    }
    return reached;
  }

 private:
  JsonView nodes_;
  std::vector<std::vector<int>> children_;
  std::vector<int> parent_;
};

// A matrix whose last row is not 0 0 0 1 moves points by perspective, which no node can: but for a factor, which
// divides the rest, that row is left out.
glm::dmat4 read_matrix(GltfFile& file, const JsonView& json) {
  glm::dmat4 matrix(1.0);
  read_numbers(file, json, {&matrix[0][0], 16});
  const glm::vec4 last(matrix[0].w, matrix[1].w, matrix[2].w, matrix[3].w);
  constexpr float kRounding = 1e-3f;
  const bool divides = std::abs(last.w - 1.0f) > kRounding && std::abs(last.w) > 1e-6f;
  if (divides) matrix /= matrix[3].w;
  for (int column = 0; column < 4; ++column) matrix[column].w = column == 3 ? 1.0 : 0.0;
  if (last != glm::vec4(0.0f, 0.0f, 0.0f, 1.0f))  // in single precision: what rounding did is no fault
    file.note(json, "is not an affine transform: its last row is taken as 0 0 0 1");
  return matrix;
}

glm::quat read_rotation(GltfFile& file, const JsonView& json) {
  glm::vec4 xyzw(0.0f, 0.0f, 0.0f, 1.0f);
  read_numbers(file, json, {&xyzw.x, 4});
  const double length = glm::length(glm::dvec4(xyzw));
  if (!(length > 1e-6)) {
    file.note(json, "is zero: taken as no rotation");
    return {1.0f, 0.0f, 0.0f, 0.0f};
  }
  constexpr double kRounding = 1e-3;
  if (std::abs(length - 1.0) > kRounding) file.note(json, "is not of unit length: brought to it");
  const glm::vec4 unit = glm::dvec4(xyzw) / length;
  return {unit.w, unit.x, unit.y, unit.z};
}

void read_transform(GltfFile& file, const JsonView& json, Node& node) {
  if (json["matrix"].present()) {
    node.matrix = read_matrix(file, json["matrix"]);
    return;
  }
  read_numbers(file, json["translation"], {&node.translation.x, 3});
  read_numbers(file, json["scale"], {&node.scale.x, 3});
  node.rotation = read_rotation(file, json["rotation"]);
}

// Reads nodes one by one; what they refer to is looked up once.
class NodeReader {
 public:
  NodeReader(GltfFile& file, const Scene& scene, const GltfIndices& indices)
      : file_(file), scene_(scene), indices_(indices), skin_count_(file.root()["skins"].size()) {}

  Node read(const JsonView& json, bool shown);
  // EXT_mesh_gpu_instancing: the nodes below `node` that show its mesh, which it shows no more. None without it.
  std::vector<Node> read_instances(const JsonView& json, Node& node, int place);

 private:
  std::vector<float> read_morph_weights(const JsonView& json, int mesh);
  template <typename T>
  std::vector<T> read_instance_attribute(const JsonView& reference, const T& neutral, std::size_t& count);

  GltfFile& file_;
  const Scene& scene_;
  const GltfIndices& indices_;
  std::size_t skin_count_;
};

// As many as the mesh has morph targets.
std::vector<float> NodeReader::read_morph_weights(const JsonView& json, int mesh) {
  std::vector<float> weights = read_number_list(file_, json);
  const std::size_t wanted = mesh < 0 ? 0 : scene_.meshes[static_cast<std::size_t>(mesh)].morph_weights.size();
  if (weights.empty() || weights.size() == wanted) return weights;
  file_.note(json, "are not one weight a morph target: cut, or filled with 0");
  weights.resize(wanted, 0.0f);
  return weights;
}

Node NodeReader::read(const JsonView& json, bool shown) {
  Node node;
  node.name = read_name(file_, json["name"]);
  read_transform(file_, json, node);
  const int mesh = json["mesh"].index(scene_.meshes.size());
  const int skin = json["skin"].index(skin_count_);
  const int camera = json["camera"].index(indices_.cameras.size());
  int light = -1;
  if (json["extensions"].present())
    light = json["extensions"]["KHR_lights_punctual"]["light"].index(indices_.lights.size());
  if (!shown) return node;
  node.mesh = mesh;
  node.skin = mesh < 0 ? -1 : skin;
  node.camera = camera < 0 ? -1 : indices_.cameras[static_cast<std::size_t>(camera)];
  node.light = light < 0 ? -1 : indices_.lights[static_cast<std::size_t>(light)];
  node.morph_weights = read_morph_weights(json["weights"], mesh);
  return node;
}

// All attributes have as many elements as the first one that is there.
template <typename T>
std::vector<T> NodeReader::read_instance_attribute(const JsonView& reference, const T& neutral, std::size_t& count) {
  if (!reference.present()) return {};
  std::vector<T> values = GltfAccessor(file_, reference).vectors<T>();
  if (count != 0 && values.size() != count) reference.fail("has another count than the other attributes of instances");
  count = values.size();
  replace_not_finite(file_, reference, values, neutral, "holds numbers that are not finite: such instances stay put");
  return values;
}

std::vector<Node> NodeReader::read_instances(const JsonView& json, Node& node, int place) {
  if (node.mesh < 0 || !json["extensions"].present()) return {};
  const JsonView attributes = json["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  if (!attributes.present()) return {};
  std::size_t count = 0;
  const auto translations = read_instance_attribute(attributes["TRANSLATION"], glm::vec3(0.0f), count);
  const auto rotations = read_instance_attribute(attributes["ROTATION"], glm::vec4(0, 0, 0, 1), count);
  const auto scales = read_instance_attribute(attributes["SCALE"], glm::vec3(1.0f), count);
  if (count == 0) return {};
  file_.budget().charge(count, sizeof(Node));
  std::vector<Node> instances(count);
  for (std::size_t i = 0; i < count; ++i) {
    Node& instance = instances[i];
    instance.parent = place;
    instance.mesh = node.mesh;
    instance.skin = node.skin;
    instance.morph_weights = node.morph_weights;
    if (!translations.empty()) instance.translation = translations[i];
    if (!scales.empty()) instance.scale = scales[i];
    if (rotations.empty()) continue;
    const float length = glm::length(rotations[i]);
    const glm::vec4 xyzw = length > 1e-6f ? rotations[i] / length : glm::vec4(0, 0, 0, 1);
    instance.rotation = {xyzw.w, xyzw.x, xyzw.y, xyzw.z};
  }
  node.mesh = node.skin = -1;
  node.morph_weights.clear();
  return instances;
}

// Nodes outside the default scene keep their place in the tree (a skin may use them) and show nothing.
std::vector<bool> nodes_shown(const GltfFile& file, const NodeTree& tree, std::size_t node_count) {
  const JsonView scenes = file.root()["scenes"];
  const int given = file.root()["scene"].index(scenes.size());
  if (scenes.size() == 0) return std::vector<bool>(node_count, true);
  const auto scene = static_cast<std::size_t>(given < 0 ? 0 : given);
  return tree.reachable(scenes[scene]["nodes"].indices(node_count));
}

// KHR_node_visibility: neither the node nor what hangs below it is shown.
bool is_hidden(const JsonView& node) {
  const JsonView extensions = node["extensions"];
  return extensions.present() && !extensions["KHR_node_visibility"]["visible"].boolean(true);
}

}  // namespace

std::vector<int> read_gltf_nodes(GltfFile& file, Scene& scene, const GltfIndices& indices) {
  const JsonView nodes = file.root()["nodes"];
  const NodeTree tree(nodes);
  const std::vector<int> order = tree.parents_first();
  const std::vector<bool> shown = nodes_shown(file, tree, nodes.size());
  NodeReader reader(file, scene, indices);
  std::vector<int> place(nodes.size(), -1);
  std::vector<bool> hidden(nodes.size(), false);
  scene.nodes.reserve(nodes.size());
  for (const int old_index : order) {
    const auto i = static_cast<std::size_t>(old_index);
    const int parent = tree.parent(old_index);
    hidden[i] = (parent >= 0 && hidden[static_cast<std::size_t>(parent)]) || is_hidden(nodes[i]);
    Node node = reader.read(nodes[i], shown[i] && !hidden[i]);
    if (parent >= 0) node.parent = place[static_cast<std::size_t>(parent)];
    place[i] = static_cast<int>(scene.nodes.size());
    std::vector<Node> instances = reader.read_instances(nodes[i], node, place[i]);
    scene.nodes.push_back(std::move(node));
    std::move(instances.begin(), instances.end(), std::back_inserter(scene.nodes));
  }
  return place;
}

}  // namespace lightwell
