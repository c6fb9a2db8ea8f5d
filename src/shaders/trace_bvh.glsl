// Tracing through our own hierarchy (passes/trace/bvh_types.h). Included by shaders/trace.glsl.
#ifndef LIGHTWELL_TRACE_BVH_GLSL
#define LIGHTWELL_TRACE_BVH_GLSL

#include "passes/trace/bvh_types.h"

layout(set = 0, binding = 27) readonly buffer TraceNodeBuffer { uvec4 data[]; } bvh_nodes;
layout(set = 0, binding = 28) readonly buffer TraceTriangleBuffer { uvec4 data[]; } bvh_triangles;

const uint kBvhStack = 160;

// A ray as boxes see it.
struct BoxRay {
  vec3 origin;
  vec3 inverse;  // of the direction; never infinite
};

// Components that are nothing beside the largest are made no smaller than 1e-20 of it: the ray ends up in the same place.
BoxRay box_ray(Ray ray) {
  vec3 size = abs(ray.direction);
  float least = max(max(size.x, size.y), size.z) * 1e-20;
  return BoxRay(ray.origin, 1.0 / mix(ray.direction, vec3(least), lessThan(size, vec3(least))));
}

// Room for the rounding of the three operations behind each distance (Ize 2013).
const float kBoxSlack = 1.0 + 4.0 / 8388608.0;

// Whether the ray meets the triangle within [t_min, t_max], and where. Edge functions of edges that two triangles share
// are each other's negative to the last bit, so that no ray slips between them. The distance is brought into the part of
// the ray inside the triangle's own box: rounding then never puts it before a box round it, and the answer does not
// depend on how the hierarchy groups triangles.
bool meet_triangle(Ray ray, BoxRay box, vec3 corners[3], out float t, out vec2 barycentrics) {
  precise vec3 a = corners[0] - ray.origin;
  precise vec3 b = corners[1] - ray.origin;
  precise vec3 c = corners[2] - ray.origin;
  vec3 ta = a * box.inverse;
  vec3 tb = b * box.inverse;
  vec3 tc = c * box.inverse;
  vec3 near3 = min(min(ta, tb), tc);
  vec3 far3 = max(max(ta, tb), tc);
  float near = max(max(near3.x, near3.y), near3.z);
  float far = min(min(far3.x, far3.y), far3.z) * kBoxSlack;

  precise vec3 ab = a - b;
  precise vec3 bc = b - c;
  precise vec3 ca = c - a;
  precise vec3 plane_ab = cross(ab, a + b);
  precise vec3 plane_bc = cross(bc, b + c);
  precise vec3 plane_ca = cross(ca, c + a);
  precise float wc = dot(plane_ab, ray.direction);
  precise float wa = dot(plane_bc, ray.direction);
  precise float wb = dot(plane_ca, ray.direction);
  float sum = wa + wb + wc;
  vec3 normal = cross(ab, ca);
  t = clamp(dot(normal, a) / dot(normal, ray.direction), near, far);
  barycentrics = vec2(wb, wc) / sum;
  bool inside = min(min(wa, wb), wc) >= 0.0 || max(max(wa, wb), wc) <= 0.0;
  return inside && sum != 0.0 && near <= far && t >= ray.t_min && t <= ray.t_max;
}

vec4 byte_planes(uint word) { return vec4(uvec4(word, word >> 8, word >> 16, word >> 24) & 255u); }

// Where the ray enters the four children of a node; beyond all numbers where it does not.
vec4 enter_children(BoxRay box, uint node, float t_min, float t_max) {
  uvec4 frame = bvh_nodes.data[kBvhNodeWords * node];
  uvec4 planes_0 = bvh_nodes.data[kBvhNodeWords * node + 1];
  uvec4 planes_1 = bvh_nodes.data[kBvhNodeWords * node + 2];
  vec3 origin = uintBitsToFloat(frame.xyz);
  vec3 steps = uintBitsToFloat((uvec3(frame.w, frame.w >> 8, frame.w >> 16) & 255u) << 23);
  uvec3 low = planes_0.xyz;
  uvec3 high = uvec3(planes_0.w, planes_1.xy);
  bvec3 backwards = lessThan(box.inverse, vec3(0.0));
  uvec3 first = mix(low, high, backwards);
  uvec3 second = mix(high, low, backwards);
  vec4 near = vec4(t_min);
  vec4 far = vec4(t_max);
  for (int axis = 0; axis < 3; ++axis) {
    near = max(near, (origin[axis] + byte_planes(first[axis]) * steps[axis] - box.origin[axis]) * box.inverse[axis]);
    far = min(far, (origin[axis] + byte_planes(second[axis]) * steps[axis] - box.origin[axis]) * box.inverse[axis] * kBoxSlack);
  }
  return mix(vec4(uintBitsToFloat(0x7f800000u)), near, lessThanEqual(near, far));
}

void order_pair(inout float t0, inout uint r0, inout float t1, inout uint r1) {
  bool swap = t1 < t0;
  float t = swap ? t1 : t0;
  uint r = swap ? r1 : r0;
  t1 = swap ? t0 : t1;
  r1 = swap ? r0 : r1;
  t0 = t;
  r0 = r;
}

// The first triangle on the ray, of several at the same t the lowest; or, with `any`, any that is on it.
RayHit trace_bvh(Ray ray, const bool any) {
  const float kBeyond = uintBitsToFloat(0x7f800000u);
  RayHit hit = RayHit(ray.t_max, kNoTriangle, vec2(0.0));
  BoxRay box = box_ray(ray);
  uint stack[kBvhStack];
  uvec4 roots = bvh_nodes.data[0];
  uint depth = roots.y == kBvhNothing ? 0 : 1;
  stack[0] = roots.y;
  uint next = roots.x;
  if (next == kBvhNothing && depth > 0) next = stack[--depth];
  uint bound = uint(bvh_nodes.data.length()) + uint(bvh_triangles.data.length());
  for (uint step = 0; step < bound && next != kBvhNothing; ++step) {
    for (; step < bound && (next & kBvhLeafFlag) == 0; ++step) {
      vec4 t = enter_children(box, next, ray.t_min, hit.t);
      uvec4 child = bvh_nodes.data[kBvhNodeWords * next + 3];
      t = mix(t, vec4(kBeyond), equal(child, uvec4(kBvhNothing)));
      order_pair(t.x, child.x, t.y, child.y);
      order_pair(t.z, child.z, t.w, child.w);
      order_pair(t.x, child.x, t.z, child.z);
      order_pair(t.y, child.y, t.w, child.w);
      order_pair(t.y, child.y, t.z, child.z);
      for (uint i = 3; i > 0; --i)
        if (t[i] < kBeyond && depth < kBvhStack) stack[depth++] = child[i];
      next = t.x < kBeyond ? child.x : depth > 0 ? stack[--depth] : kBvhNothing;
    }
    if (next == kBvhNothing) break;
    uint first = next & kBvhSlotMask;
    uint count = ((next >> kBvhLeafCountShift) & 3u) + 1;
    for (uint i = first; i < first + count; ++i) {
      uvec4 a = bvh_triangles.data[kBvhTriangleWords * i];
      vec3 corners[3];
      corners[0] = uintBitsToFloat(a.xyz);
      corners[1] = uintBitsToFloat(bvh_triangles.data[kBvhTriangleWords * i + 1].xyz);
      corners[2] = uintBitsToFloat(bvh_triangles.data[kBvhTriangleWords * i + 2].xyz);
      float t;
      vec2 barycentrics;
      bool met = meet_triangle(ray, box, corners, t, barycentrics) && (t < hit.t || (t == hit.t && a.w < hit.triangle));
      bool uncertain = met && may_be_cut_out(a.w);
      for (uint once = 0; once < (uncertain ? 1 : 0); ++once) met = !is_cut_out(a.w, barycentrics);
      if (met) hit = RayHit(t, a.w, barycentrics);
    }
    next = (any && hit.triangle != kNoTriangle) || depth == 0 ? kBvhNothing : stack[--depth];
  }
  return hit;
}

RayHit trace_closest(Ray ray) { return trace_bvh(ray, false); }

bool is_blocked(Ray ray) { return trace_bvh(ray, true).triangle != kNoTriangle; }

#endif
