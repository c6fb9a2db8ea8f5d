#version 460
#extension GL_EXT_ray_query : require
// Distance along +z from the origin to the first triangle; -1 if there is none.
layout(local_size_x = 1) in;
layout(set = 0, binding = 0) uniform accelerationStructureEXT structure;
layout(set = 0, binding = 1) buffer Distance { float value; } depth;

void main() {
  rayQueryEXT query;
  rayQueryInitializeEXT(query, structure, gl_RayFlagsOpaqueEXT, 0xff, vec3(0.0), 0.0, vec3(0.0, 0.0, 1.0), 100.0);
  rayQueryProceedEXT(query);
  bool hit = rayQueryGetIntersectionTypeEXT(query, true) != gl_RayQueryCommittedIntersectionNoneEXT;
  depth.value = hit ? rayQueryGetIntersectionTEXT(query, true) : -1.0;
}
