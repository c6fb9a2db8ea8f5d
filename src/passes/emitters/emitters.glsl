// Points on emissive triangles, chosen in proportion to power. The including kernel declares, before including this
// file (and includes shaders/trace.glsl or what it is made of first),
//   layout(set = 0, binding = n) readonly buffer EmitterBuffer { EmissiveTriangle data[]; } emitters;
//   layout(set = 0, binding = n) readonly buffer GroupBuffer { EmitterGroup data[]; } groups;
// and has their number in params.emitter_count.
#ifndef LIGHTWELL_EMITTERS_GLSL
#define LIGHTWELL_EMITTERS_GLSL

#include "passes/emitters/emitters_types.h"
#include "shaders/constants.glsl"

// Whether any emitter needs its texture coordinates.
layout(constant_id = 1) const bool kEmittersLookUp = true;

struct EmitterChoice {
  uint index;
  float place;  // within the triangle's share of u: 0 to 1
};

// The triangle whose share of all power holds `u` in [0,1).
EmitterChoice choose_emitter(uint count, float u) {
  uint group_count = (count + kEmitterGroup - 1) / kEmitterGroup;
  float power = u * groups.data[group_count].power_before;
  // The last group before which there is no more power than that, ...
  uint low = 0;
  uint high = group_count - 1;
  for (int i = 0; i < 20 && low < high; ++i) {
    uint middle = (low + high + 1) / 2;
    if (groups.data[middle].power_before > power) high = middle - 1;
    else low = middle;
  }
  power -= groups.data[low].power_before;
  // ... and the first triangle of it that ends beyond it.
  uint first = low * kEmitterGroup;
  low = first;
  high = min(first + kEmitterGroup, count) - 1;
  for (int i = 0; i < 7 && low < high; ++i) {
    uint middle = (low + high) / 2;
    if (emitters.data[middle].power_so_far > power) high = middle;
    else low = middle + 1;
  }
  float below = low == first ? 0.0 : emitters.data[low - 1].power_so_far;
  float own = emitters.data[low].power_so_far - below;
  return EmitterChoice(low, own > 0.0 ? clamp((power - below) / own, 0.0, 0.99999994) : 0.5);
}

// Uniform barycentric weights of the second and third corner, with little distortion of the square (Heitz 2019).
vec2 triangle_point(vec2 u) {
  return u.y > u.x ? vec2(0.5 * u.x, u.y - 0.5 * u.x) : vec2(u.x - 0.5 * u.y, 0.5 * u.y);
}

float all_power() { return groups.data[(params.emitter_count + kEmitterGroup - 1) / kEmitterGroup].power_before; }

struct EmitterPoint {
  vec3 position;
  vec3 front;        // perpendicular to the triangle; unit
  vec3 radiance;     // W/(sr m^2), from the sides that emit
  bool both_sides;
  float inverse_density;    // m^2; 0: of no use
  float factor_luminance;   // of the emission without its texture
};

EmitterPoint sample_emitter(vec2 u) {
  EmitterChoice choice = choose_emitter(params.emitter_count, u.x);
  EmissiveTriangle emitter = emitters.data[choice.index];
  vec2 weights = triangle_point(vec2(choice.place, u.y));

  EmitterPoint point;
  point.position = emitter.corner + weights.x * emitter.edge_1 + weights.y * emitter.edge_2;
  vec3 front = cross(emitter.edge_1, emitter.edge_2);
  float twice_area = length(front);
  point.front = twice_area > 0.0 ? front / twice_area : vec3(0.0);
  point.radiance = emitter.emission;
  point.both_sides = (emitter.flags & kEmitsFromBothSides) != 0;
  point.inverse_density = all_power() / emitter.luminance;
  point.factor_luminance = luminance(emitter.emission);
  if (kEmittersLookUp && (emitter.flags & kEmitterLooksUp) != 0) {
    if ((emitter.flags & kEmitterMirrored) != 0) weights = weights.yx;
    Triangle t = load_triangle(emitter.triangle);
    vec4 uv = triangle_uv(t, weights);
    GpuMaterial material = scene_material(vertex_material(t.v[0]));
    point.radiance = emitted_radiance(material, uv, vec4(0.0), vec4(0.0), true);
    if (is_hole(material, base_color(material, triangle_color(t, weights), uv, vec4(0.0), vec4(0.0)).a)) point.radiance = vec3(0.0);
  }
  return point;
}

// Of geometry terms cos cos / d^2: the largest with which a sample of emitters brings all of its light. Nearer by, one
// sample would be too bright, 1 / d^2; what is left out is what a cosine-distributed ray brings that hits the emitter,
// times left_to_cosine_rays(). `share`: about how many times brighter than such a ray's a sample may be; the smaller or
// fainter an emitter is among all, the nearer it may be.
float largest_geometry_term(float factor_luminance, float share) { return kPi * factor_luminance / (share * all_power()); }

// `distance`: of the hit; cosines at both ends. `factor_luminance`: of the emission without its texture.
float left_to_cosine_rays(float factor_luminance, float share, float distance, float cosine, float cosine_there) {
  return max(0.0, 1.0 - largest_geometry_term(factor_luminance, share) * distance * distance /
                            max(cosine * cosine_there, 1e-30));
}

#endif
