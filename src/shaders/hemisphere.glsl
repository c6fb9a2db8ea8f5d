// Directions about a normal. A frame is three unit vectors, each perpendicular to the others; the third is the normal.
#ifndef LIGHTWELL_HEMISPHERE_GLSL
#define LIGHTWELL_HEMISPHERE_GLSL

#include "shaders/constants.glsl"

// The frame turns smoothly with the unit `normal`, but at one place (Duff et al. 2017).
mat3 frame_about(vec3 normal) {
  float side = normal.z < 0.0 ? -1.0 : 1.0;
  float a = -1.0 / (side + normal.z);
  float b = normal.x * normal.y * a;
  return mat3(vec3(1.0 + side * normal.x * normal.x * a, side * b, -side * normal.x),
              vec3(b, side + normal.y * normal.y * a, -normal.y), normal);
}

// The unit square to the unit disk with little distortion, equal areas to equal areas (Shirley and Chiu 1997).
vec2 disk_point(vec2 u) {
  vec2 p = 2.0 * u - 1.0;
  bool wide = abs(p.x) > abs(p.y);
  float radius = wide ? p.x : p.y;
  float ratio = (wide ? p.y : p.x) / (radius != 0.0 ? radius : 1.0);
  float angle = 0.25 * kPi * ratio;
  return radius * (wide ? vec2(cos(angle), sin(angle)) : vec2(sin(angle), cos(angle)));
}

// A point of the disk, lifted to the hemisphere (Malley's method): points spread evenly over the disk give directions of
// density cos / pi. All lie above the horizon: sine and cosine may be wrong by 2^-11, so that disk_point() gives points
// beyond the circle, too, and a ray along the surface that it leaves would be lost.
vec3 cosine_direction(mat3 frame, vec2 disk) {
  const float kLeastHeight = 1.0 / 4096.0;  // far more than the rounding of the frame
  float height = sqrt(max(kLeastHeight * kLeastHeight, 1.0 - dot(disk, disk)));
  return normalize(disk.x * frame[0] + disk.y * frame[1] + height * frame[2]);
}

#endif
