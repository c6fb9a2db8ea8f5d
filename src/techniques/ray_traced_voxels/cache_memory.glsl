// What a pixel remembers of the end of its ray, so that the next frame can ask whether the light there has changed: two
// RGBA32UI images, a texel a block of pixels.
//   0: position of the end; normal, packed
//   1: triangle's normal, albedo, both packed; luminance of what direct light it sends on; of all light
#ifndef LIGHTWELL_CACHE_MEMORY_GLSL
#define LIGHTWELL_CACHE_MEMORY_GLSL

#include "shaders/light_point.glsl"
#include "shaders/luminance.glsl"

struct RayEnd {
  vec3 position;
  uint normal;
  uint face_normal;
  uint albedo;
  float direct;  // luminance of radiosity, W/m^2; the albedo as it is kept here
  float all;     // 0: there is none
};

const RayEnd kNoRayEnd = RayEnd(vec3(0.0), 0, 0, 0, 0.0, 0.0);

RayEnd make_ray_end(Surface surface, vec3 direct, vec3 all) {
  uint albedo = packUnorm4x8(vec4(surface.albedo, 1.0));
  return RayEnd(surface.position, pack_unit_vector(surface.normal), pack_unit_vector(surface.face_normal), albedo,
                luminance(unpackUnorm4x8(albedo).rgb * direct), luminance(all));
}

uvec4 first_words(RayEnd end) { return uvec4(floatBitsToUint(end.position), end.normal); }
uvec4 last_words(RayEnd end) {
  return uvec4(end.face_normal, end.albedo, floatBitsToUint(end.direct), floatBitsToUint(end.all));
}

RayEnd ray_end_of(uvec4 first, uvec4 last) {
  return RayEnd(uintBitsToFloat(first.xyz), first.w, last.x, last.y, uintBitsToFloat(last.z), uintBitsToFloat(last.w));
}

#endif
