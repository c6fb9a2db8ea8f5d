// Rays from the camera (Magalhaes 2020, section 3.3.2, designed there and not built). A shadow ray goes to every light
// from where a ray hits; a mirrored ray goes on, and what the lights give where that one hits counts for the first
// hit's voxel. One invocation a ray.
#ifndef LIGHTWELL_RAY_TRACED_VOXELS_PAPER_INJECT_CAMERA_GLSL
#define LIGHTWELL_RAY_TRACED_VOXELS_PAPER_INJECT_CAMERA_GLSL

#include "shaders/software_drivers.glsl"

vec3 camera_direction(vec2 u) {
  vec2 place = 2.0 * u - 1.0;
  vec3 across = place.x * camera.tan_half_x * camera.right - place.y * camera.tan_half_y * camera.up;
  return normalize(camera.forward + across);
}

// Irradiance from all lights on the side of the voxel's normal.
vec3 lights_irradiance(vec3 start, vec3 normal, bool wanted) {
  const float kLightClearance = 1e-4;  // of the distance: a light on a surface shines all the same
  vec3 sum = vec3(0.0);
  for (uint i = 0; i < LW_ROUNDS_IF(wanted, params.light); ++i) {
    GpuLight light = lights.data[i];
    vec3 to_light;
    vec3 perpendicular = unshadowed_irradiance(light, start, to_light);
    float cosine = dot(normal, to_light);
    bool lit = cosine > 0.0 && perpendicular != vec3(0.0);
    bool parallel = light.type == kLightDirectional;
    vec3 way = parallel ? to_light : light.position - start;
    if (lit) lit = !is_dark(start, way, parallel ? 1e30 : 1.0 - kLightClearance);
    if (lit) sum += perpendicular * cosine;
  }
  return sum;
}

void main() {
  uint blocks = (params.side + kRayBlock - 1) / kRayBlock;
  uint index = linear_invocation();
  if (index >= blocks * blocks * kRayBlock * kRayBlock) return;
  uvec2 place = ray_place(index);
  bool going = all(lessThan(place, uvec2(params.side)));

  VoxelHit hit = VoxelHit(vec3(0.0), kNoVoxel);
  vec3 origin = camera.position;
  vec3 direction = camera_direction((vec2(place) + 0.5) / float(params.side));
  float least = 0.0;
  vec3 part = vec3(1.0);  // of what a hit reflects towards the last one that arrives at the first
  float cosine = 0.0;     // at which the ray left
  for (uint bounce = 0; bounce <= min(params.secondaries, kMostSecondaries) && going; ++bounce) {
    Found found = find_surface(origin, least, direction);
    going = has_surface(found.voxel);
    vec3 normal = going ? voxel_normal(found.voxel) : vec3(0.0);
    vec3 irradiance = lights_irradiance(found.start, normal, going);
    if (bounce == 0) {
      hit = VoxelHit(irradiance, going ? found.voxel : kNoVoxel);
    } else if (going) {
      part *= voxel_albedo(found.voxel) * (cosine / max(found.t * found.t, kLeastSquare));
      hit.irradiance += part * irradiance;
    }
    vec3 mirrored;
    going = mirror(direction, normal, mirrored) && going;
    origin = found.start;
    least = params.least_distance;
    direction = mirrored;
    cosine = max(0.0, dot(normal, mirrored));
  }
  hits.data[index] = hit;
}

#endif
