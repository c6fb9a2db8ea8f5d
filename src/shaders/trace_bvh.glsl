// Tracing through our own hierarchy (passes/trace/bvh_types.h). Included by shaders/trace.glsl.
#ifndef LIGHTWELL_TRACE_BVH_GLSL
#define LIGHTWELL_TRACE_BVH_GLSL

#include "passes/trace/bvh_types.h"
#include "shaders/paged_buffer.glsl"

LW_PAGED_READ(2, 0, uvec4, bvh_nodes)
LW_PAGED_READ(2, 1, uvec4, bvh_triangles)

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

#define LW_BEYOND uintBitsToFloat(0x7f800000u)

// Room for the rounding of the three operations behind each distance (Ize 2013).
const float kBoxSlack = 1.0 + 4.0 / 8388608.0;

// Where the ray meets the triangle; t is minus infinity if nowhere. Edge functions are volumes spanned by an edge and the
// ray: those of an edge that two triangles share are each other's negative to the last bit, so that no ray slips between
// them. The distance is brought into the part of the ray inside the triangle's own box: rounding then never puts it
// before a box round it, and the answer does not depend on how the hierarchy groups triangles.
RayHit meet_triangle(Ray ray, BoxRay box, vec3 corner_a, vec3 corner_b, vec3 corner_c) {
  precise vec3 a = corner_a - ray.origin;
  precise vec3 b = corner_b - ray.origin;
  precise vec3 c = corner_c - ray.origin;
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
  precise float wc = dot(cross(ab, a + b), ray.direction);
  precise float wa = dot(cross(bc, b + c), ray.direction);
  precise float wb = dot(cross(ca, c + a), ray.direction);
  float sum = wa + wb + wc;
  vec3 normal = cross(ab, ca);
  float t = clamp(dot(normal, a) / dot(normal, ray.direction), near, far);
  bool inside = min(min(wa, wb), wc) >= 0.0 || max(max(wa, wb), wc) <= 0.0;
  return RayHit(inside && sum != 0.0 && near <= far ? t : -LW_BEYOND, kNoTriangle, vec2(wb, wc) / sum);
}

vec4 byte_planes(uint word) { return vec4(uvec4(word, word >> 8, word >> 16, word >> 24) & 255u); }

// The order in which to visit the four children of a node, smallest first; beyond all numbers where the ray misses one:
// the distance at which it is entered; with `any`, minus the length of the ray inside, for there are hits to be found.
vec4 enter_children(BoxRay box, uint node, float t_min, float t_max, const bool any) {
  uvec4 frame = bvh_nodes_at(kBvhNodeWords * node);
  uvec4 planes_0 = bvh_nodes_at(kBvhNodeWords * node + 1);
  uvec4 planes_1 = bvh_nodes_at(kBvhNodeWords * node + 2);
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
  return mix(vec4(LW_BEYOND), any ? near - far : near, lessThanEqual(near, far));
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

// The first triangle on the ray, of several at the same t the lowest; or, with `any`, any that is on it. Loops test at
// their end (shaders/software_drivers.glsl).
RayHit trace_bvh(Ray ray, const bool any) {
  RayHit hit = RayHit(ray.t_max, kNoTriangle, vec2(0.0));
  BoxRay box = box_ray(ray);
  uvec4 roots = bvh_nodes_at(0);
  uint stack[kBvhStack];
  stack[0] = kBvhNothing;
  stack[1] = roots.y;
  uint depth = roots.y == kBvhNothing ? 1 : 2;
  uint next = roots.x;
  if (next == kBvhNothing) next = stack[--depth];
  // No ray visits a node twice, unless the hierarchy is broken.
  uint step = 0;
  uint bound = bvh_nodes_count() + bvh_triangles_count();

  do {
    RayHit masked = RayHit(0.0, kNoTriangle, vec2(0.0));
    do {
      // Down to a leaf.
      do {
        if ((next & kBvhLeafFlag) == 0) {
          vec4 t = enter_children(box, next, ray.t_min, hit.t, any);
          uvec4 child = bvh_nodes_at(kBvhNodeWords * next + 3);
          t = mix(t, vec4(LW_BEYOND), equal(child, uvec4(kBvhNothing)));
          // Leaves first: what is met there ends the search.
          if (any) t -= vec4(child >> 31) * 1e30;
          order_pair(t.x, child.x, t.y, child.y);
          order_pair(t.z, child.z, t.w, child.w);
          order_pair(t.x, child.x, t.z, child.z);
          if (!any) {
            order_pair(t.y, child.y, t.w, child.w);
            order_pair(t.y, child.y, t.z, child.z);
          }
          depth = min(depth, kBvhStack - 4);
          stack[depth] = child.w;
          depth += t.w < LW_BEYOND ? 1 : 0;
          stack[depth] = child.z;
          depth += t.z < LW_BEYOND ? 1 : 0;
          stack[depth] = child.y;
          depth += t.y < LW_BEYOND ? 1 : 0;
          stack[depth] = child.x;
          depth += t.x < LW_BEYOND ? 1 : 0;
          next = stack[--depth];
        }
        ++step;
      } while ((next & kBvhLeafFlag) == 0 && step < bound);
      // Through leaves, up to a triangle that may have holes.
      do {
        if (next != kBvhNothing) {
          uint word = kBvhTriangleWords * (next & kBvhSlotMask);
          uvec4 a = bvh_triangles_at(word);
          vec3 b = uintBitsToFloat(bvh_triangles_at(word + 1).xyz);
          vec3 c = uintBitsToFloat(bvh_triangles_at(word + 2).xyz);
          RayHit found = meet_triangle(ray, box, uintBitsToFloat(a.xyz), b, c);
          found.triangle = a.w;
          bool met = found.t >= ray.t_min && (found.t < hit.t || (found.t == hit.t && a.w < hit.triangle));
          if (met && may_be_cut_out(a.w)) masked = found;
          if (met && !may_be_cut_out(a.w)) hit = found;
          // The rest of the leaf: one slot further, one triangle fewer.
          bool last = ((next >> kBvhLeafCountShift) & 3u) == 0;
          if (any && hit.triangle != kNoTriangle) {
            next = kBvhNothing;
          } else {
            next = last ? stack[--depth] : next + 1 - (1u << kBvhLeafCountShift);
          }
        }
        ++step;
      } while ((next & kBvhLeafFlag) != 0 && next != kBvhNothing && masked.triangle == kNoTriangle && step < bound);
    } while (next != kBvhNothing && masked.triangle == kNoTriangle && step < bound);
    // Out here, where it is seldom run.
    if (kOpaqueTriangles != kNoTriangle && masked.triangle != kNoTriangle) {
      if (!is_cut_out(masked.triangle, masked.barycentrics)) hit = masked;
      if (any && hit.triangle != kNoTriangle) next = kBvhNothing;
    }
  } while (next != kBvhNothing && step < bound);
  return hit;
}

RayHit trace_closest(Ray ray) { return trace_bvh(ray, false); }

bool is_blocked(Ray ray) { return trace_bvh(ray, true).triangle != kNoTriangle; }

#endif
