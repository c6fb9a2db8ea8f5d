// Parallel rays of suns and skies, in a large scene aimed at where it is looked at. Needs light_paths_params.h; to be
// included before light_rays.glsl.
#ifndef LIGHTWELL_AIMED_RAYS_GLSL
#define LIGHTWELL_AIMED_RAYS_GLSL

#include "passes/light_paths/box_rays.glsl"
#include "shaders/hemisphere.glsl"

// Share of the rays of suns and skies that are aimed at each ball about the focus, and of those over the whole scene.
float aim_share() { return 1.0 / float(params.aim_count + 1); }

// The balls' part of the density of parallel rays, 1/m^2 across them, `squared` m^2 beside the focus.
float aim_density(float squared) {
  float density = 0.0;
  float radius = params.aim_radius;
  for (uint i = 0; i < params.aim_count; ++i) {
    if (squared < radius * radius) density += aim_share() / (kPi * radius * radius);
    radius *= params.aim_ratio;
  }
  return density;
}

// Where a line enters the scene's box.
vec3 enter_box(vec3 point, vec3 direction) {
  vec3 behind = mix(point - params.high, point - params.low, greaterThan(direction, vec3(0.0)));
  float back = 3e38;
  for (int i = 0; i < 3; ++i)
    if (abs(direction[i]) > 1e-12) back = min(back, behind[i] / direction[i]);
  return point - direction * back;
}

// A ray along the unit `direction` into the scene. In a large one the rays' density is a mixture: evenly over the box and
// over each ball's disc. `area`: 1 over the density there, m^2.
vec3 parallel_start(vec3 direction, vec2 u, out float area) {
  area = projected_area(direction);
  if (params.aim_count == 0) return entry_point(direction, u);
  float strip = u.x * float(params.aim_count + 1);
  uint ball = min(uint(strip), params.aim_count);
  u.x = min(strip - float(ball), 0.99999994);
  vec3 origin;
  if (ball == params.aim_count) {
    origin = entry_point(direction, u);
  } else {
    vec2 disk = params.aim_radius * pow(params.aim_ratio, float(ball)) * disk_point(u);
    origin = enter_box(params.focus + frame_about(direction) * vec3(disk, 0.0), direction);
  }
  vec3 across = cross(origin - params.focus, direction);
  area = 1.0 / (aim_share() / area + aim_density(dot(across, across)));
  return origin;
}

// The area that a single ray near the focus would stand for; by it sources are compared.
float parallel_area(float box_area) {
  return params.aim_count == 0 ? box_area : 1.0 / (aim_share() / box_area + aim_density(0.0));
}

#endif
