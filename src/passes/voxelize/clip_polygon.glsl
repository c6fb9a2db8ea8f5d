// Convex polygons cut by boxes.
#ifndef LIGHTWELL_CLIP_POLYGON_GLSL
#define LIGHTWELL_CLIP_POLYGON_GLSL

// A triangle cut by the six planes of a box has at most 9 vertices, a quadrilateral 10.
struct Polygon {
  int count;
  vec3 v[10];
};

// Keeps the part where sign * (x[axis] - level) >= 0 (Sutherland and Hodgman 1974).
void clip_by_plane(inout Polygon polygon, int axis, float sign, float level) {
  Polygon result;
  result.count = 0;
  for (int i = 0; i < polygon.count; ++i) {
    vec3 a = polygon.v[i];
    vec3 b = polygon.v[i + 1 == polygon.count ? 0 : i + 1];
    float da = sign * (a[axis] - level);
    float db = sign * (b[axis] - level);
    if (da >= 0.0 && result.count < 10) result.v[result.count++] = a;
    if ((da >= 0.0) != (db >= 0.0) && result.count < 10) result.v[result.count++] = mix(a, b, da / (da - db));
  }
  polygon = result;
}

void clip_by_box(inout Polygon polygon, vec3 low, vec3 high) {
  for (int axis = 0; axis < 3; ++axis) {
    clip_by_plane(polygon, axis, 1.0, low[axis]);
    clip_by_plane(polygon, axis, -1.0, high[axis]);
  }
}

// Area and centre of gravity of a flat polygon; 0 and the first vertex where it has no area.
float polygon_area(Polygon polygon, out vec3 center) {
  center = polygon.v[0];
  vec3 twice = vec3(0.0);
  for (int i = 2; i < polygon.count; ++i)
    twice += cross(polygon.v[i - 1] - polygon.v[0], polygon.v[i] - polygon.v[0]);
  float size = length(twice);
  if (polygon.count < 3 || size == 0.0) return 0.0;
  vec3 moment = vec3(0.0);
  for (int i = 2; i < polygon.count; ++i) {
    float part = dot(cross(polygon.v[i - 1] - polygon.v[0], polygon.v[i] - polygon.v[0]), twice) / (size * size);
    moment += part * (polygon.v[i - 1] + polygon.v[i] - 2.0 * polygon.v[0]) / 3.0;
  }
  center += moment;
  return 0.5 * size;
}

#endif
