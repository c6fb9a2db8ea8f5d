// A node's box: six faces of two triangles.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/svo/svo_nodes.glsl"
#include "shaders/camera.h"

layout(set = 0, binding = 0) uniform Camera { LW_GPU_CAMERA(LW_DECLARE_MEMBER) } camera;

layout(location = 0) out vec2 place;      // on the face, 0 to 1
layout(location = 1) flat out uint leaf;  // 1: occupied leaf; 0: inner node
layout(location = 2) flat out uint axis;  // of the face's normal

void main() {
  uvec4 node = svo_nodes_at(gl_InstanceIndex);
  leaf = (node.x & kSvoLeaf) != 0 ? 1 : 0;

  uint face = gl_VertexIndex / 6;
  axis = face / 2;
  uint corner = gl_VertexIndex % 6;  // of triangles 0 1 3 and 0 3 2
  corner = corner < 3 ? corner + (corner >> 1) : corner == 3 ? 0 : corner == 4 ? 3 : 2;
  place = vec2(corner & 1u, corner >> 1);
  vec3 turned = vec3(place, float(face & 1u));
  vec3 unit = face < 2 ? turned.zxy : face < 4 ? turned.yzx : turned.xyz;

  vec3 low = vec3(unpack_cell(node.z));
  vec3 high = vec3(unpack_cell(node.w) + 1);
  // In finest cells from svo_frame.data.center.
  uint level = (node.x >> kSvoLevelShift) & kSvoLevelMask;
  ivec3 first = (svo_windows.data[level].xyz << int(level)) - svo_frame.data.center;
  vec3 corner_place = vec3(first) + mix(low, high, unit) * float(1u << level);
  vec3 world = svo_frame.data.place + corner_place * svo_frame.data.cell_size;
  gl_Position = camera.view_projection * vec4(world, 1.0);
  // Edges of large boxes lie on faces of small ones: a little nearer, they are seen. Depth is 1 / distance.
  gl_Position.z *= leaf != 0 ? 1.0 : 1.001;
  // Outside where there is nothing to see.
  if ((node.x & kSvoOccupied) == 0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}
