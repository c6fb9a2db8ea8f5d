// What is kept of a pixel's surface until the next frame, in one texel of RGBA32UI.
#ifndef LIGHTWELL_SURFACE_RECORD_GLSL
#define LIGHTWELL_SURFACE_RECORD_GLSL

#include "shaders/octahedral.glsl"

struct SurfaceRecord {
  float distance;  // along the camera's forward axis, m; 0: no surface
  vec3 normal;     // unit shading normal
  uint material;   // index: surfaces of different materials share no history
};

uvec4 pack_surface(SurfaceRecord s) {
  return uvec4(floatBitsToUint(s.distance), packSnorm2x16(to_octahedron(s.normal)), s.material, 0);
}

SurfaceRecord unpack_surface(uvec4 texel) {
  return SurfaceRecord(uintBitsToFloat(texel.x), from_octahedron(unpackSnorm2x16(texel.y)), texel.z);
}

#endif
