// Whether two visible points belong to one surface: what keeps filters from mixing light across edges.
#ifndef LIGHTWELL_SAME_SURFACE_GLSL
#define LIGHTWELL_SAME_SURFACE_GLSL

// Exponent of the weight that the point `there` (w: distance, 0: nothing is visible) gets at `here`, from 0 down: four
// for each `spacing` (m) that it is off the plane through `here`. That sees creases as well as steps, and a plane from
// any angle as one.
float log_same_surface(vec3 here, vec3 normal, vec4 there, float spacing) {
  return there.w > 0.0 ? -4.0 * abs(dot(normal, there.xyz - here)) / spacing : -1e3;
}

#endif
