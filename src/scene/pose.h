// Where the nodes and vertices of a scene are.
#pragma once

#include <vector>

#include <glm/ext/matrix_double4x4.hpp>

#include "lightwell/scene.h"

namespace lightwell {

// A node's transform relative to its parent.
glm::dmat4 local_transform(const Node& node);

// One matrix a node, relative to `origin`, in double precision: far from 0 a parent and its child may nearly cancel.
// Parents must come before their children.
std::vector<glm::dmat4> world_transforms(const std::vector<Node>& nodes, const glm::dvec3& origin);

// The instance that a node with a mesh shows. `nodes` are the scene's, moved or at rest; `world` is
// world_transforms() of them.
MeshInstance make_instance(const Scene& scene, const std::vector<Node>& nodes, const std::vector<glm::dmat4>& world,
                           int node);

// Whether the instance's joints place the primitive, instead of to_world.
bool is_skinned(const Primitive& primitive, const MeshInstance& instance);

// Whether the instance shows the primitive mirrored, so that its triangles turn the other way round. Skins are mirrored
// as a whole: as their first joint is.
bool is_mirrored(const Primitive& primitive, const MeshInstance& instance);

// Positions of a primitive of the instance's mesh in the world, after morphing and either skinning or the instance's
// transform.
std::vector<glm::vec3> pose_positions(const Primitive& primitive, const MeshInstance& instance);

struct PosedVertices {
  std::vector<glm::vec3> positions;  // in the world
  std::vector<glm::vec3> normals;    // unit
};

// The same with normals.
PosedVertices pose_primitive(const Primitive& primitive, const MeshInstance& instance);

}  // namespace lightwell
