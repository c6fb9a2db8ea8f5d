// Tracing by VK_KHR_ray_query. Included by shaders/trace.glsl.
#ifndef LIGHTWELL_TRACE_RAY_QUERY_GLSL
#define LIGHTWELL_TRACE_RAY_QUERY_GLSL

RayHit trace_closest(Ray ray) { return RayHit(ray.t_max, kNoTriangle, vec2(0.0)); }

bool is_blocked(Ray ray) { return trace_closest(ray).triangle != kNoTriangle; }

#endif
