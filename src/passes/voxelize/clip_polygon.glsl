// Convex polygons cut by boxes.
#ifndef LIGHTWELL_CLIP_POLYGON_GLSL
#define LIGHTWELL_CLIP_POLYGON_GLSL
#extension GL_EXT_control_flow_attributes : require

// A triangle cut by the six planes of a box has at most 9 vertices, a quadrilateral 10.
const int kPolygonVertices = 10;

struct Polygon {
  int count;
  int first;                         // 0 or kPolygonVertices: cutting copies from one half to the other
  vec3 v[2 * kPolygonVertices];
};

vec3 polygon_vertex(Polygon polygon, int i) { return polygon.v[polygon.first + i]; }

// Keeps the part where sign * (x[axis] - level) >= 0 (Sutherland and Hodgman 1974).
void clip_by_plane(inout Polygon polygon, int axis, float sign, float level) {
  int target = kPolygonVertices - polygon.first;
  int count = 0;
  vec3 a = polygon.v[polygon.first + polygon.count - 1];
  float da = sign * (a[axis] - level);
  [[dont_unroll]] for (int i = 0; i < polygon.count; ++i) {
    vec3 b = polygon.v[polygon.first + i];
    float db = sign * (b[axis] - level);
    if ((da >= 0.0) != (db >= 0.0) && count < kPolygonVertices) polygon.v[target + count++] = mix(a, b, da / (da - db));
    if (db >= 0.0 && count < kPolygonVertices) polygon.v[target + count++] = b;
    a = b;
    da = db;
  }
  polygon.first = target;
  polygon.count = count;
}

// `low`, `high`: bounds of the polygon before it is cut; planes beyond them are passed over.
void clip_by_box(inout Polygon polygon, vec3 low, vec3 high, vec3 box_low, vec3 box_high) {
  [[dont_unroll]] for (int plane = 0; plane < 6; ++plane) {
    int axis = plane >> 1;
    bool is_low = (plane & 1) == 0;
    bool cuts = is_low ? low[axis] < box_low[axis] : high[axis] > box_high[axis];
    if (cuts && polygon.count > 0) clip_by_plane(polygon, axis, is_low ? 1.0 : -1.0, is_low ? box_low[axis] : box_high[axis]);
  }
}

// Area and centre of gravity of a flat polygon; 0 and the first vertex where it has no area.
float polygon_area(Polygon polygon, out vec3 center) {
  vec3 origin = polygon_vertex(polygon, 0);
  vec3 first = polygon_vertex(polygon, 1) - origin;
  vec3 twice = vec3(0.0);
  vec3 moment = vec3(0.0);
  // The triangles of a fan: half of |cross| each, about a third of the sum of their corners.
  [[dont_unroll]] for (int i = 2; i < polygon.count; ++i) {
    vec3 second = polygon_vertex(polygon, i) - origin;
    vec3 part = cross(first, second);
    twice += part;
    moment += length(part) * (first + second) / 3.0;
    first = second;
  }
  float size = length(twice);
  bool is_flat = polygon.count < 3 || size == 0.0;
  center = is_flat ? origin : origin + moment / size;
  return is_flat ? 0.0 : 0.5 * size;
}

#endif
