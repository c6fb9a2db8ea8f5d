// The light of one splat at one pixel. The kernel declares params, shadow_atlas, kEstimate and kKernel.
#ifndef LIGHTWELL_SPLAT_LIGHT_GLSL
#define LIGHTWELL_SPLAT_LIGHT_GLSL

#include "techniques/photon_splatting/shadow_atlas.glsl"
#include "techniques/photon_splatting/splat_kernel.glsl"
#include "techniques/photon_splatting/splat_rules.glsl"

struct SplatPixel {
  vec4 place;   // m; w: 0 where there is no surface
  vec3 normal;  // shading normal
  vec3 face;    // the triangle's, on the same side
};

// A splat with what does not depend on the pixel.
struct SplatRay {
  mat3 frame;   // third: along the ray
  vec3 center;
  vec3 normal;  // of the surface at the center
  vec3 light;   // W/m^2 across the ray, or the colour
  float half_width;
  float per_width;  // 1 / half_width
  float reach;
  ivec2 map;        // first texel
};

SplatRay make_splat_ray(Splat splat) {
  float per_width = 1.0 / splat.half_width;
  // A mean has the colour of one photon, a density the flux of all, which only the part that finds a surface divides.
  float density = per_width * per_width / (kernel_area() * splat.accepted);
  float share = kEstimate == kEstimateDensity ? density : params.scale / splat.photons;
  return SplatRay(frame_about(splat.direction), splat.center, unpack_unit_vector(splat.normal), share * splat.flux,
                  splat.half_width, per_width, splat.reach,
                  map_corner(splat.map, params.maps_per_row, params.map_side));
}

// Whether the nearest texel of the map has nothing before the pixel, but for `tolerance`.
bool is_lit(SplatRay ray, vec2 across, float depth, float tolerance) {
  return depth <= texelFetch(shadow_atlas, ray.map + map_texel(across, params.map_side), 0).x + tolerance;
}

// The same, where the map holds 0 for what its splat does not light. A texel's ray went through its middle: so there
// the pixel's plane is compared with it; `slope`: of that plane, m along the ray for each m across. A surface that ends
// within texels is accepted in half of them: what lies in the others is lit as in one of the four nearest.
bool is_lit_on_plane(SplatRay ray, vec2 across, float depth, vec2 slope, float tolerance) {
  vec2 place = (0.5 * across + 0.5) * float(params.map_side);
  vec2 corner = clamp(floor(place + 0.5), 1.0, float(params.map_side) - 1.0);  // that the four share
  vec4 map = textureGather(shadow_atlas, (vec2(ray.map) + corner) / vec2(textureSize(shadow_atlas, 0)));
  vec2 first = (corner - 0.5 - place) * (2.0 * ray.half_width / float(params.map_side));
  vec2 second = (corner + 0.5 - place) * (2.0 * ray.half_width / float(params.map_side));
  vec4 to_middle = slope.x * vec4(first.x, second.x, second.x, first.x) +
                   slope.y * vec4(second.y, second.y, first.y, first.y);
  bvec2 is_second = greaterThanEqual(place, corner);
  vec4 nearest = is_second.y ? vec4(!is_second.x, is_second.x, 0.0, 0.0) : vec4(0.0, 0.0, is_second.x, !is_second.x);
  vec4 lit = vec4(lessThanEqual(vec4(depth) + to_middle, map + tolerance)) * vec4(greaterThan(map, vec4(0.0)));
  return dot(lit, dot(map, nearest) > 0.0 ? nearest : vec4(1.0)) > 0.0;
}

vec4 light_of(SplatRay ray, SplatPixel pixel) {
  const float kLeastSlope = 0.05;  // cosine to the ray below which a plane's depth across a texel means nothing
  vec3 place = (pixel.place.xyz - ray.center) * ray.frame;
  vec2 across = place.xy * ray.per_width;
  float weight = abs(place.z) < ray.reach && pixel.place.w > 0.0 ? kernel_weight(across) : 0.0;
  float depth = place.z + ray.reach;
  float tolerance = params.tolerance * 2.0 * ray.half_width / float(params.map_side);
  bool lit;
  if (kEstimate == kEstimateDensity) {
    vec3 n = pixel.face * ray.frame;
    float off = dot(pixel.place.xyz - ray.center, ray.normal) * ray.per_width;
    lit = n.z < 0.0 && dot(pixel.face, ray.normal) >= kLeastLikeness && abs(off) < kMostOff &&
          is_lit_on_plane(ray, across, depth, n.xy / max(-n.z, kLeastSlope), tolerance);
  } else {
    lit = is_lit(ray, across, depth, tolerance);
  }
  if (!lit) weight = 0.0;
  float cosine = max(0.0, -dot(pixel.normal, ray.frame[2]));
  return vec4((weight * cosine) * ray.light, weight);
}

#endif
