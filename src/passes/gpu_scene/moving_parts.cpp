#include "passes/gpu_scene/moving_parts.h"

#include <algorithm>
#include <cstddef>

#include "passes/gpu_scene/posed_parts.h"

namespace lightwell {
namespace {

struct AnimatedNodes {
  std::vector<bool> moved;    // the node or an ancestor
  std::vector<bool> morphed;  // the node's weights
};

AnimatedNodes list_animated_nodes(const Scene& scene) {
  AnimatedNodes nodes{std::vector<bool>(scene.nodes.size()), std::vector<bool>(scene.nodes.size())};
  for (const Animation& animation : scene.animations) {
    for (const AnimationChannel& channel : animation.channels) {
      (channel.path == AnimationPath::kMorphWeights ? nodes.morphed
                                                    : nodes.moved)[static_cast<std::size_t>(channel.node)] = true;
    }
  }
  // Parents come before their children.
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const int parent = scene.nodes[i].parent;
    if (parent >= 0 && nodes.moved[static_cast<std::size_t>(parent)]) nodes.moved[i] = true;
  }
  return nodes;
}

bool is_animated(const Scene& scene, const AnimatedNodes& nodes, std::size_t node, const Primitive& primitive) {
  if (nodes.morphed[node] && !primitive.morph_targets.empty()) return true;
  const int skin = scene.nodes[node].skin;
  if (skin < 0 || primitive.joints.empty()) return nodes.moved[node];
  const std::vector<int>& joints = scene.skins[static_cast<std::size_t>(skin)].joints;
  return std::any_of(joints.begin(), joints.end(),
                     [&](int joint) { return nodes.moved[static_cast<std::size_t>(joint)]; });
}

}  // namespace

std::vector<bool> list_animated_parts(const Scene& scene, const std::vector<MeshInstance>& instances) {
  const AnimatedNodes nodes = list_animated_nodes(scene);
  std::vector<bool> animated;
  for (const MeshInstance& instance : instances) {
    for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives) {
      animated.push_back(instance.node >= 0 &&
                         is_animated(scene, nodes, static_cast<std::size_t>(instance.node), primitive));
    }
  }
  return animated;
}

std::vector<bool> list_moved_parts(const std::vector<FlatPart>& parts, const std::vector<MeshInstance>& before,
                                   const std::vector<MeshInstance>& after) {
  std::vector<bool> moved;
  for (const FlatPart& part : parts) {
    const MeshInstance& then = before[part.instance];
    const MeshInstance& now = after[part.instance];
    const bool placed_anew =
        is_skinned(part, then) || is_skinned(part, now) ? then.joints != now.joints : then.to_world != now.to_world;
    const bool morphed = part.shape.morph_target_count > 0 && then.morph_weights != now.morph_weights;
    moved.push_back(placed_anew || morphed);
  }
  return moved;
}

}  // namespace lightwell
