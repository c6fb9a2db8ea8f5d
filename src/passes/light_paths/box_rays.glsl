// Parallel rays over the scene's bounding box, params.low to params.high.
#ifndef LIGHTWELL_BOX_RAYS_GLSL
#define LIGHTWELL_BOX_RAYS_GLSL

// Area of the scene's bounding box seen along `direction`, m^2.
float projected_area(vec3 direction) {
  vec3 extent = params.high - params.low;
  return dot(abs(direction), extent.yzx * extent.zxy);
}

// A point where a ray along the unit `direction` enters the box, spread evenly over the box's projection.
vec3 entry_point(vec3 direction, vec2 u) {
  vec3 extent = params.high - params.low;
  vec3 areas = abs(direction) * extent.yzx * extent.zxy;
  vec3 entry = mix(params.high, params.low, greaterThan(direction, vec3(0.0)));
  float place = u.x * (areas.x + areas.y + areas.z);
  if (place < areas.x) {
    entry.yz = params.low.yz + extent.yz * vec2(place / areas.x, u.y);
  } else if (place < areas.x + areas.y) {
    entry.zx = params.low.zx + extent.zx * vec2((place - areas.x) / areas.y, u.y);
  } else {
    entry.xy = params.low.xy + extent.xy * vec2(min((place - areas.x - areas.y) / max(areas.z, 1e-30), 1.0), u.y);
  }
  return entry;
}

#endif
