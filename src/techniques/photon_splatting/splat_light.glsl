// The light of one splat at one pixel. The kernel declares params, shadow_atlas, kEstimate and kKernel.
#ifndef LIGHTWELL_SPLAT_LIGHT_GLSL
#define LIGHTWELL_SPLAT_LIGHT_GLSL

#include "shaders/constants.glsl"
#include "techniques/photon_splatting/shadow_atlas.glsl"
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

// Weight at `across`, half widths from the axis. Its integral over the plane across the ray is `kernel_area`.
float kernel_weight(vec2 across) {
  float squared = dot(across, across);
  if (kKernel == kSplatTent) return max(0.0, 1.0 - sqrt(squared));
  if (kKernel == kSplatGaussian) return squared < 1.0 ? exp(-2.0 * squared) : 0.0;
  return all(lessThan(abs(across), vec2(1.0))) ? 1.0 : 0.0;
}

// Half widths squared.
float kernel_area() {
  if (kKernel == kSplatTent) return kPi / 3.0;
  if (kKernel == kSplatGaussian) return 0.5 * kPi * (1.0 - exp(-2.0));
  return 4.0;
}

SplatRay make_splat_ray(Splat splat) {
  float per_width = 1.0 / splat.half_width;
  // A mean has the colour of one photon, a density the flux of all, which only the part that finds a surface divides.
  float density = per_width * per_width / (kernel_area() * splat.accepted);
  float share = kEstimate == kEstimateDensity ? density : params.scale / splat.photons;
  return SplatRay(frame_about(splat.direction), splat.center, unpack_unit_vector(splat.normal), share * splat.flux,
                  splat.half_width, per_width, splat.reach,
                  map_corner(splat.map, params.maps_per_row, params.map_side));
}

vec4 light_of(SplatRay ray, SplatPixel pixel) {
  const float kLeastSlope = 0.05;  // cosine to the ray below which a plane's depth across a texel means nothing
  vec3 place = (pixel.place.xyz - ray.center) * ray.frame;
  vec2 across = place.xy * ray.per_width;
  float weight = abs(place.z) < ray.reach && pixel.place.w > 0.0 ? kernel_weight(across) : 0.0;

  ivec2 texel = map_texel(across, params.map_side);
  float texel_side = 2.0 * ray.half_width / float(params.map_side);
  float map_depth = texelFetch(shadow_atlas, ray.map + texel, 0).x;
  float depth = place.z + ray.reach;
  if (kEstimate == kEstimateDensity) {
    // The map's ray went through the middle of its texel: so there the pixel's plane is compared with it.
    vec3 n = pixel.face * ray.frame;
    vec2 to_middle = (texel_place(texel, params.map_side) - across) * ray.half_width;
    if (n.z < -kLeastSlope) depth -= dot(n.xy, to_middle) / n.z;
    if (n.z >= 0.0 || dot(pixel.face, ray.normal) < kLeastLikeness) weight = 0.0;
  }
  if (depth > map_depth + params.tolerance * texel_side) weight = 0.0;
  float cosine = max(0.0, -dot(pixel.normal, ray.frame[2]));
  return vec4((weight * cosine) * ray.light, weight);
}

#endif
