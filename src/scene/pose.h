// Where the nodes and vertices of a scene are.
#pragma once

#include <vector>

#include "lightwell/scene.h"

namespace lightwell {

// A node's transform relative to its parent.
glm::mat4 local_transform(const Node& node);

// One matrix a node. The scene's parents must come before their children.
std::vector<glm::mat4> world_transforms(const Scene& scene);

// For each joint of a skin, the matrix that takes vertices from the mesh's bind pose to the world.
std::vector<glm::mat4> joint_matrices(const Skin& skin, const std::vector<glm::mat4>& world);

struct PosedVertices {
  std::vector<glm::vec3> positions;  // in the world
  std::vector<glm::vec3> normals;    // unit
};

// Vertices of a primitive of the node's mesh after morphing, skinning and the node's transform. Skinned meshes ignore
// their own node's transform (glTF 2.0, 3.7.3.3). `world` is world_transforms(scene).
PosedVertices pose_primitive(const Scene& scene, const std::vector<glm::mat4>& world, int node_index,
                             const Primitive& primitive);

}  // namespace lightwell
