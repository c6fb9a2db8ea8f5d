// Tracing through our own hierarchy. Included by shaders/trace.glsl.
#ifndef LIGHTWELL_TRACE_BVH_GLSL
#define LIGHTWELL_TRACE_BVH_GLSL

// Moeller and Trumbore 1997. True if the ray meets the triangle within [t_min, t_max].
bool meet_triangle(Ray ray, vec3 a, vec3 b, vec3 c, out float t, out vec2 barycentrics) {
  vec3 e1 = b - a;
  vec3 e2 = c - a;
  vec3 p = cross(ray.direction, e2);
  float determinant = dot(e1, p);
  vec3 s = ray.origin - a;
  vec3 q = cross(s, e1);
  barycentrics = vec2(dot(s, p), dot(ray.direction, q)) / determinant;
  t = dot(e2, q) / determinant;
  return determinant != 0.0 && barycentrics.x >= 0.0 && barycentrics.y >= 0.0 && barycentrics.x + barycentrics.y <= 1.0 &&
         t >= ray.t_min && t <= ray.t_max;
}

RayHit trace_closest(Ray ray) {
  RayHit hit = RayHit(ray.t_max, kNoTriangle, vec2(0.0));
  for (uint i = 0; i < indices.data.length() / 3; ++i) {
    Triangle triangle = load_triangle(i);
    float t;
    vec2 barycentrics;
    if (meet_triangle(ray, vertex_position(triangle.v[0]), vertex_position(triangle.v[1]), vertex_position(triangle.v[2]),
                      t, barycentrics) &&
        t < hit.t && !(i >= kOpaqueTriangles && is_cut_out(i, barycentrics)))
      hit = RayHit(t, i, barycentrics);
  }
  return hit;
}

bool is_blocked(Ray ray) { return trace_closest(ray).triangle != kNoTriangle; }

#endif
