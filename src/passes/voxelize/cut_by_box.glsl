// The part of a flat surface, a whole plane or a triangle of it, that lies inside a box: its area, centre and bounds.
//
// Seen along the axis of its normal's largest component, w, the part is a convex polygon in (u, v): the intersection
// of at most nine half planes, the triangle's three, the box's four, and two where the plane passes through the box's
// bottom and top. A half plane's line is on the polygon's border where all the others allow it, and area and centre
// are sums over the border (Green's theorem). No list of vertices is kept, so there is nothing to index at run time
// and no branch, as there is in the usual polygon clipping (shaders/software_drivers.glsl).
#ifndef LIGHTWELL_CUT_BY_BOX_GLSL
#define LIGHTWELL_CUT_BY_BOX_GLSL

struct FlatPiece {
  float area;
  vec3 center;
  vec3 low, high;  // bounds; low > high where nothing is left
};

// Half planes n.x + c >= 0 with unit n, in groups; (0, 0, 1) allows everything. All relative to the box's centre.
struct HalfPlanes {
  mat3 edges;    // columns (n, c)
  mat4x3 sides;
  mat2x3 caps;
};

struct BorderSum {
  float twice_area;
  vec2 moment;  // 3 * twice the area * centre
  vec2 low, high;
};

// Cuts the line's range of t by a half plane: its value at t = 0, its change with t, the cosine between the two
// normals. Of two lines that coincide only the one that is asked first is on the border, and neither is where they
// face each other.
void narrow(float value, float change, float cosine, bool is_first, inout vec2 range) {
  const float kSame = 1e-5;
  if (abs(change) < 1e-6) {
    if (value < -kSame || (value <= kSame && (cosine < 0.0 || !is_first))) range = vec2(1.0, 0.0);
  } else if (change > 0.0) {
    range.x = max(range.x, -value / change);
  } else {
    range.y = min(range.y, -value / change);
  }
}

void narrow_by(vec3 half_plane, vec3 line, vec2 start, vec2 direction, bool is_first, inout vec2 range) {
  if (half_plane.xy == vec2(0.0)) {
    if (half_plane.z < 0.0) range = vec2(1.0, 0.0);
    return;
  }
  narrow(dot(half_plane.xy, start) + half_plane.z, dot(half_plane.xy, direction), dot(half_plane.xy, line.xy), is_first,
         range);
}

// Line `self` of the nine: edges 0 to 2, sides 3 to 6, caps 7 and 8.
void add_border(HalfPlanes planes, vec3 line, int self, inout BorderSum sum) {
  if (line.xy == vec2(0.0)) return;
  vec2 start = -line.z * line.xy;
  vec2 direction = vec2(line.y, -line.x);  // the inside is on its left
  vec2 range = vec2(-1e9, 1e9);
  for (int i = 0; i < 3; ++i)
    if (self != i) narrow_by(planes.edges[i], line, start, direction, self < i, range);
  for (int i = 0; i < 4; ++i)
    if (self != 3 + i) narrow_by(planes.sides[i], line, start, direction, self < 3 + i, range);
  for (int i = 0; i < 2; ++i)
    if (self != 7 + i) narrow_by(planes.caps[i], line, start, direction, self < 7 + i, range);
  if (range.x >= range.y) return;
  vec2 p = start + range.x * direction;
  vec2 q = start + range.y * direction;
  float part = p.x * q.y - p.y * q.x;
  sum.twice_area += part;
  sum.moment += part * (p + q);
  sum.low = min(sum.low, min(p, q));
  sum.high = max(sum.high, max(p, q));
}

// The line through a and b with the side of `inside`; everything where a and b are one point.
vec3 edge_half_plane(vec2 a, vec2 b, vec2 inside) {
  vec2 n = vec2(a.y - b.y, b.x - a.x);
  float size = length(n);
  if (size == 0.0) return vec3(0.0, 0.0, 1.0);
  n /= size;
  if (dot(n, inside - a) < 0.0) n = -n;
  return vec3(n, -dot(n, a));
}

// The half plane where slope.uv + offset >= 0.
vec3 slope_half_plane(vec2 slope, float offset) {
  float size = length(slope);
  return size < 1e-6 ? vec3(0.0, 0.0, offset) : vec3(slope, offset) / size;
}

// `point` and unit `normal`: the plane. `edges`: half planes of the triangle, relative to the box's centre, in (u, v)
// = axes (axis + 1) % 3 and (axis + 2) % 3 with `axis` that of the normal's largest component.
FlatPiece cut_plane(vec3 point, vec3 normal, mat3 edges, vec3 low, vec3 high) {
  vec3 size = abs(normal);
  int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  // Cyclic change of axes: (u, v, w).
  vec3 center = 0.5 * (low + high);
  vec3 half_size = 0.5 * (high - low);
  vec3 n = axis == 0 ? normal.yzx : axis == 1 ? normal.zxy : normal;
  vec3 h = axis == 0 ? half_size.yzx : axis == 1 ? half_size.zxy : half_size;
  vec3 o = point - center;
  o = axis == 0 ? o.yzx : axis == 1 ? o.zxy : o;

  // The plane is w = w_0 + slope.uv; caps: -h_w <= w <= h_w.
  vec2 slope = -n.xy / n.z;
  float w_0 = o.z - dot(slope, o.xy);
  HalfPlanes planes;
  planes.edges = edges;
  planes.sides = mat4x3(1, 0, h.x, -1, 0, h.x, 0, 1, h.y, 0, -1, h.y);
  planes.caps = mat2x3(slope_half_plane(slope, h.z + w_0 + 1e-6), slope_half_plane(-slope, h.z - w_0 + 1e-6));

  BorderSum sum = BorderSum(0.0, vec2(0.0), vec2(1e9), vec2(-1e9));
  for (int i = 0; i < 3; ++i) add_border(planes, planes.edges[i], i, sum);
  for (int i = 0; i < 4; ++i) add_border(planes, planes.sides[i], 3 + i, sum);
  for (int i = 0; i < 2; ++i) add_border(planes, planes.caps[i], 7 + i, sum);
  if (sum.twice_area <= 0.0) return FlatPiece(0.0, point, vec3(1.0), vec3(0.0));

  vec2 middle = clamp(sum.moment / (3.0 * sum.twice_area), sum.low, sum.high);
  vec2 reach_low = min(slope * sum.low, slope * sum.high);
  vec2 reach_high = max(slope * sum.low, slope * sum.high);
  vec3 p = vec3(middle, clamp(w_0 + dot(slope, middle), -h.z, h.z));
  vec3 a = vec3(sum.low, max(-h.z, w_0 + reach_low.x + reach_low.y));
  vec3 b = vec3(sum.high, min(h.z, w_0 + reach_high.x + reach_high.y));
  FlatPiece piece;
  piece.area = 0.5 * sum.twice_area / abs(n.z);
  piece.center = center + (axis == 0 ? p.zxy : axis == 1 ? p.yzx : p);
  piece.low = center + (axis == 0 ? a.zxy : axis == 1 ? a.yzx : a);
  piece.high = center + (axis == 0 ? b.zxy : axis == 1 ? b.yzx : b);
  return piece;
}

const mat3 kNoEdges = mat3(0, 0, 1, 0, 0, 1, 0, 0, 1);

FlatPiece cut_plane(vec3 point, vec3 normal, vec3 low, vec3 high) {
  return cut_plane(point, normal, kNoEdges, low, high);
}

// `normal`: unit.
FlatPiece cut_triangle(vec3 a, vec3 b, vec3 c, vec3 normal, vec3 low, vec3 high) {
  vec3 size = abs(normal);
  int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  vec3 center = 0.5 * (low + high);
  vec2 p = axis == 0 ? (a - center).yz : axis == 1 ? (a - center).zx : (a - center).xy;
  vec2 q = axis == 0 ? (b - center).yz : axis == 1 ? (b - center).zx : (b - center).xy;
  vec2 r = axis == 0 ? (c - center).yz : axis == 1 ? (c - center).zx : (c - center).xy;
  mat3 edges = mat3(edge_half_plane(p, q, r), edge_half_plane(q, r, p), edge_half_plane(r, p, q));
  return cut_plane(a, normal, edges, low, high);
}

#endif
