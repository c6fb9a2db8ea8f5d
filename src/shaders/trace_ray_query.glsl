// Tracing by VK_KHR_ray_query. Included by shaders/trace.glsl.
#ifndef LIGHTWELL_TRACE_RAY_QUERY_GLSL
#define LIGHTWELL_TRACE_RAY_QUERY_GLSL

#extension GL_EXT_ray_query : require

#include "shaders/finite.glsl"

layout(set = 2, binding = 0) uniform accelerationStructureEXT acceleration_structure;
// The scene's triangle that each geometry begins with, by bottom level (passes/trace/ray_query_scene.h).
layout(set = 2, binding = 1) uniform FirstTriangleBlock { uvec4 of_level[2]; } first_triangles;

rayQueryEXT ray_query;

// Runs a query to its end; true if it met something. What a ray must be for a query to be defined is checked first
// (Vulkan 1.3, VUID-RuntimeSpirv-OpRayQueryInitializeKHR-06348 to 06352).
bool run_ray_query(Ray ray, uint flags) {
  if (!is_finite(ray.origin) || !is_finite(ray.direction) || ray.direction == vec3(0.0) || !(ray.t_min <= ray.t_max))
    return false;
  // Devices may leave out both ends of the range; ours include them.
  const float kUlp = 1.0 / 8388608.0;
  rayQueryInitializeEXT(ray_query, acceleration_structure, flags, 0xff, ray.origin, max(ray.t_min, 0.0) * (1.0 - kUlp),
                        ray.direction, ray.t_max * (1.0 + kUlp));
  // Only triangles that may have holes are offered, none of them twice.
  uint triangles = indices_count() / 3;
  for (uint offered = 0; offered <= triangles && rayQueryProceedEXT(ray_query); ++offered) {
    uint first = first_triangles.of_level[rayQueryGetIntersectionInstanceCustomIndexEXT(ray_query, false)]
                                         [rayQueryGetIntersectionGeometryIndexEXT(ray_query, false)];
    uint triangle = first + rayQueryGetIntersectionPrimitiveIndexEXT(ray_query, false);
    if (!is_cut_out(triangle, rayQueryGetIntersectionBarycentricsEXT(ray_query, false)))
      rayQueryConfirmIntersectionEXT(ray_query);
  }
  return rayQueryGetIntersectionTypeEXT(ray_query, true) != gl_RayQueryCommittedIntersectionNoneEXT;
}

bool is_blocked(Ray ray) {
  return run_ray_query(ray, gl_RayFlagsTerminateOnFirstHitEXT);
}

RayHit trace_closest(Ray ray) {
  if (!run_ray_query(ray, gl_RayFlagsNoneEXT)) return RayHit(ray.t_max, kNoTriangle, vec2(0.0));
  uint first = first_triangles.of_level[rayQueryGetIntersectionInstanceCustomIndexEXT(ray_query, true)]
                                       [rayQueryGetIntersectionGeometryIndexEXT(ray_query, true)];
  return RayHit(rayQueryGetIntersectionTEXT(ray_query, true),
                first + rayQueryGetIntersectionPrimitiveIndexEXT(ray_query, true),
                rayQueryGetIntersectionBarycentricsEXT(ray_query, true));
}

#endif
