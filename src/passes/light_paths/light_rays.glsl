// Rays that leave lights in proportion to their intensity, as far as they can meet the scene. Needs
// light_paths_params.h.
#ifndef LIGHTWELL_LIGHT_RAYS_GLSL
#define LIGHTWELL_LIGHT_RAYS_GLSL

#include "passes/light_paths/box_rays.glsl"
#include "shaders/hemisphere.glsl"
#include "shaders/lights.glsl"

#ifndef LIGHTWELL_AIMED_RAYS_GLSL
// `area`: 1 over the density of the rays, m^2.
vec3 parallel_start(vec3 direction, vec2 u, out float area) {
  area = projected_area(direction);
  return entry_point(direction, u);
}

float parallel_area(float box_area) { return box_area; }
#endif

// A direction within a cone, evenly over solid angle. `height`: 1 - cosine of the cone's half angle, exact for narrow
// ones.
vec3 cone_direction(vec3 axis, float height, vec2 u) {
  float z = u.x * height;
  float sine = sqrt(max(z * (2.0 - z), 0.0));
  float angle = 2.0 * kPi * u.y;
  return normalize(frame_about(axis) * vec3(sine * cos(angle), sine * sin(angle), 1.0 - z));
}

// 1 - cosine of half the angle under which the scene's bounding sphere is seen; 2 (everywhere) from inside it.
float scene_cone_height(vec3 position, out vec3 axis) {
  vec3 offset = 0.5 * (params.low + params.high) - position;
  float radius = 0.5 * length(params.high - params.low);
  float distance_squared = dot(offset, offset);
  float sine_squared = radius * radius / max(distance_squared, 1e-30);
  bool outside = sine_squared < 0.98;
  axis = outside ? offset * inversesqrt(distance_squared) : vec3(0.0, 0.0, 1.0);
  return outside ? sine_squared / (1.0 + sqrt(1.0 - sine_squared)) : 2.0;
}

// The integral of a spot's fall-off over solid angle, over 2 pi: its inner cone, and t^2 beyond.
float spot_height(GpuLight light) {
  return (1.0 - light.cos_inner) + max(light.cos_inner - light.cos_outer, 0.0) / 3.0;
}

struct LightRay {
  vec3 origin;
  vec3 direction;  // unit
  vec3 flux;       // W, over the density with which it was chosen
  float angle;     // sr, 1 over the density of its direction; 0 where rays are parallel
  float area;      // m^2 across the ray, 1 over the density of its origin; 0 at a point
  float inverse_range;  // of the light, 1/m
};

LightRay light_ray(GpuLight light, vec2 u, vec2 place) {
  LightRay ray;
  ray.origin = light.position;
  ray.area = 0.0;
  ray.inverse_range = light.inverse_range;
  if (light.type == kLightDirectional) {
    ray.direction = light.direction;
    ray.origin = parallel_start(light.direction, place, ray.area);
    ray.angle = 0.0;
    ray.flux = light.intensity * ray.area;
    return ray;
  }
  vec3 axis;
  float height = scene_cone_height(light.position, axis);
  if (light.type == kLightSpot && spot_height(light) <= height) {
    // As the spot shines: evenly in its inner cone, beyond it with t^3 even.
    float inner = (1.0 - light.cos_inner) / max(spot_height(light), 1e-30);
    float t = pow(max((1.0 - u.x) / max(1.0 - inner, 1e-30), 0.0), 1.0 / 3.0);
    float outer_height = 1.0 - light.cos_outer - min(t, 1.0) * (light.cos_inner - light.cos_outer);
    float z = u.x < inner ? u.x / inner * (1.0 - light.cos_inner) : outer_height;
    ray.direction = cone_direction(light.direction, z, vec2(1.0, u.y));
    ray.angle = 2.0 * kPi * spot_height(light);  // of the inner cone
    ray.flux = light.intensity * ray.angle;
    return ray;
  }
  ray.direction = cone_direction(axis, height, u);
  ray.angle = 2.0 * kPi * height;
  ray.flux = light_intensity(light, ray.direction) * ray.angle;
  return ray;
}

// Flux (W) that light_ray() distributes, about: of a spot that shines past the scene it is less. Of a sun over a large
// scene it is what goes to the focus: a kilometre of ground must not take all paths from a lamp there.
vec3 light_flux(GpuLight light) {
  if (light.type == kLightDirectional) return light.intensity * parallel_area(projected_area(light.direction));
  vec3 axis;
  float height = scene_cone_height(light.position, axis);
  if (light.type == kLightSpot) height = min(height, spot_height(light));
  return light.intensity * (2.0 * kPi * height);
}

#endif
