#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "core/log.h"
#include "lightwell/error.h"
#include "scene/gltf_parts.h"

namespace lightwell {

namespace {

// A camera without a far plane sees this many times as far as its near plane.
constexpr float kInfiniteFarPlane = 1e5f;

Light read_light(const JsonView& json) {
  Light light;
  light.name = json["name"].string("");
  glm::vec3 color(1.0f);
  json["color"].read({&color.x, 3});
  light.intensity = color * json["intensity"].number(1.0f);
  const std::string type = json["type"].string("");
  if (type == "point") {
    light.type = LightType::kPoint;
  } else if (type == "directional") {
    light.type = LightType::kDirectional;
  } else if (type == "spot") {
    light.type = LightType::kSpot;
    light.inner_angle = json["spot"]["innerConeAngle"].number(light.inner_angle);
    light.outer_angle = json["spot"]["outerConeAngle"].number(light.outer_angle);
  } else {
    json.fail("unknown light type '" + type.substr(0, 20) + "'");
  }
  return light;
}

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

void read_transform(const JsonView& json, Node& node) {
  if (json["matrix"].present()) {
    glm::mat4 matrix(1.0f);
    json["matrix"].read({&matrix[0][0], 16});
    if (matrix[0].w != 0.0f || matrix[1].w != 0.0f || matrix[2].w != 0.0f || matrix[3].w != 1.0f)
      json["matrix"].fail("is not an affine transform");
    node.matrix = matrix;
    return;
  }
  json["translation"].read({&node.translation.x, 3});
  json["scale"].read({&node.scale.x, 3});
  glm::vec4 rotation(0.0f, 0.0f, 0.0f, 1.0f);
  json["rotation"].read({&rotation.x, 4});
  const float length = glm::length(rotation);
  if (!(length > 1e-6f) || !std::isfinite(length)) json["rotation"].fail("is not a rotation");
  rotation /= length;
  node.rotation = glm::quat(rotation.w, rotation.x, rotation.y, rotation.z);
}

Node read_node(const JsonView& json, const GltfFile& file, const std::vector<int>& cameras, bool shown) {
  const JsonView root = file.root();
  Node node;
  node.name = json["name"].string("");
  read_transform(json, node);
  const int mesh = json["mesh"].index(root["meshes"].size());
  const int skin = json["skin"].index(root["skins"].size());
  const int camera = json["camera"].index(cameras.size());
  const int light = json["extensions"]["KHR_lights_punctual"]["light"].index(
      root["extensions"]["KHR_lights_punctual"]["lights"].size());
  if (!shown) return node;
  node.mesh = mesh;
  node.skin = mesh < 0 ? -1 : skin;
  node.camera = camera < 0 ? -1 : cameras[static_cast<std::size_t>(camera)];
  node.light = light;
  node.morph_weights = json["weights"].numbers();
  return node;
}

// Nodes outside the default scene keep their place in the tree (a skin may use them) and show nothing.
std::vector<bool> nodes_shown(const GltfFile& file, const NodeTree& tree, std::size_t node_count) {
  const JsonView scenes = file.root()["scenes"];
  const int given = file.root()["scene"].index(scenes.size());
  if (scenes.size() == 0) return std::vector<bool>(node_count, true);
  const auto scene = static_cast<std::size_t>(given < 0 ? 0 : given);
  return tree.reachable(scenes[scene]["nodes"].indices(node_count));
}

}  // namespace

std::vector<int> read_gltf_cameras(GltfFile& file, Scene& scene) {
  const JsonView cameras = file.root()["cameras"];
  std::vector<int> indices;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const JsonView json = cameras[i];
    if (json["type"].string("perspective") != "perspective") {
      log_warning(file.path() + ": camera " + std::to_string(i) + " is not a perspective camera: left out");
      indices.push_back(-1);
      continue;
    }
    const JsonView perspective = json["perspective"];
    Camera camera;
    camera.name = json["name"].string("");
    camera.yfov = perspective["yfov"].number(camera.yfov);
    camera.znear = perspective["znear"].number(camera.znear);
    camera.zfar = perspective["zfar"].number(camera.znear * kInfiniteFarPlane);
    indices.push_back(static_cast<int>(scene.cameras.size()));
    scene.cameras.push_back(std::move(camera));
  }
  return indices;
}

void read_gltf_lights(GltfFile& file, Scene& scene) {
  const JsonView lights = file.root()["extensions"]["KHR_lights_punctual"]["lights"];
  for (std::size_t i = 0; i < lights.size(); ++i) scene.lights.push_back(read_light(lights[i]));
}

std::vector<int> read_gltf_nodes(GltfFile& file, Scene& scene, const std::vector<int>& cameras) {
  const JsonView nodes = file.root()["nodes"];
  const NodeTree tree(nodes);
  const std::vector<int> order = tree.parents_first();
  const std::vector<bool> shown = nodes_shown(file, tree, nodes.size());
  std::vector<int> place(nodes.size(), -1);
  scene.nodes.reserve(nodes.size());
  for (const int old_index : order) {
    const auto i = static_cast<std::size_t>(old_index);
    Node node = read_node(nodes[i], file, cameras, shown[i]);
    const int parent = tree.parent(old_index);
    if (parent >= 0) node.parent = place[static_cast<std::size_t>(parent)];
    place[i] = static_cast<int>(scene.nodes.size());
    scene.nodes.push_back(std::move(node));
  }
  return place;
}

}  // namespace lightwell
