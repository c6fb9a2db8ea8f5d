// Rays against the scene's triangles. After shaders/trace.glsl and paper_inject.glsl.
#ifndef LIGHTWELL_RAY_TRACED_VOXELS_PAPER_FIND_TRIANGLE_GLSL
#define LIGHTWELL_RAY_TRACED_VOXELS_PAPER_FIND_TRIANGLE_GLSL

Found find_surface(vec3 origin, float least, vec3 direction) {
  RayHit hit = trace_closest(Ray(origin, least, direction, kFarAway));
  if (hit.triangle == kNoTriangle) return Found(-1.0, kNoVoxel, vec3(0.0));
  vec3 position = origin + hit.t * direction;
  vec3 face = front_normal(load_triangle(hit.triangle));
  face = normalize(dot(face, direction) < 0.0 ? face : -face);
  return Found(hit.t, voxel_of(params.grid, position), ray_start(position, face));
}

bool is_dark(vec3 start, vec3 direction, float most) { return is_blocked(Ray(start, 0.0, direction, most)); }

#endif
