// Rays from a light, and the mirrored ones that follow (Magalhaes 2020, sections 4.3.2.2 to 4.3.2.5). One invocation a
// ray. The published code sends the rays of its one spot light through a square in front of it; here each kind of light
// has its own square of equal shares.
#ifndef LIGHTWELL_RAY_TRACED_VOXELS_PAPER_INJECT_LIGHT_GLSL
#define LIGHTWELL_RAY_TRACED_VOXELS_PAPER_INJECT_LIGHT_GLSL

layout(constant_id = 0) const uint kMirrored = 0;  // 1: rays go on from where the last ones hit
layout(constant_id = 1) const uint kKeepRays = 0;  // 1: others will follow

// A ray with what it carries, W/sr; W/m^2 where it comes from a directional light.
struct LightSample {
  vec3 origin;
  float least;  // m
  vec3 direction;
  float spread;  // 1: falls off with the square of the distance, 0: does not
  vec3 color;
};

// The unit square to a cap of the sphere, equal areas to equal areas; `height`: 1 - cosine of its half angle.
vec3 cap_direction(vec3 axis, float height, vec2 u) {
  vec2 disk = disk_point(u);
  float square = dot(disk, disk);
  vec2 sine = disk * sqrt(max(height * (2.0 - height * square), 0.0));
  return normalize(frame_about(axis) * vec3(sine, 1.0 - height * square));
}

LightSample leave_light(GpuLight light, vec2 u) {
  LightSample ray = LightSample(light.position, 0.0, light.direction, 1.0, light.intensity);
  if (light.type == kLightDirectional) {
    ray.origin = entry_point(light.direction, u);
    ray.spread = 0.0;
    return ray;
  }
  vec3 axis = light.direction;
  float height = 1.0 - light.cos_outer;
  if (light.type == kLightPoint) height = scene_cone_height(light.position, axis);
  ray.direction = cap_direction(axis, height, u);
  ray.color = light_intensity(light, ray.direction);
  return ray;
}

// As published the irradiance where the last ray hit becomes what the next one carries, once multiplied by albedo.
bool leave_mirror(VoxelHit hit, VoxelRay last, out LightSample ray) {
  ray = LightSample(last.position.xyz, params.least_distance, last.direction.xyz, 1.0, vec3(0.0));
  if (hit.voxel == kNoVoxel) return false;
  ray.color = hit.irradiance * voxel_albedo(hit.voxel);
  return mirror(last.direction.xyz, voxel_normal(hit.voxel), ray.direction) && ray.color != vec3(0.0);
}

void main() {
  uint blocks = (params.side + kRayBlock - 1) / kRayBlock;
  uint index = linear_invocation();
  if (index >= blocks * blocks * kRayBlock * kRayBlock) return;
  uvec2 place = ray_place(index);
  bool going = all(lessThan(place, uvec2(params.side)));
  LightSample ray;
  if (kMirrored == 0)
    ray = leave_light(lights.data[params.light], (vec2(place) + 0.5) / float(params.side));
  else
    going = leave_mirror(hits.data[index], rays.data[index], ray) && going;

  VoxelHit hit = VoxelHit(vec3(0.0), kNoVoxel);
  Found found = Found(-1.0, kNoVoxel, vec3(0.0));
  if (going) found = find_surface(ray.origin, ray.least, ray.direction);
  if (has_surface(found.voxel)) {
    float cosine = max(0.0, -dot(ray.direction, voxel_normal(found.voxel)));
    float fall_off = ray.spread == 0.0 ? 1.0 : 1.0 / max(found.t * found.t, kLeastSquare);
    if (kMirrored == 0) fall_off *= range_fall_off(lights.data[params.light].inverse_range, found.t * found.t);
    hit = VoxelHit(ray.color * (cosine * fall_off), found.voxel);
  }
  hits.data[index] = hit;
  if (kKeepRays != 0) rays.data[index] = VoxelRay(vec4(found.start, 0.0), vec4(ray.direction, 0.0));
}

#endif
