// What a light point sends to a surface.
#ifndef LIGHTWELL_LIGHT_POINT_GLSL
#define LIGHTWELL_LIGHT_POINT_GLSL

#include "shaders/constants.glsl"
#include "shaders/light_point.h"
#include "shaders/octahedral.glsl"

uint pack_unit_vector(vec3 v) { return packSnorm2x16(to_octahedron(v)); }
vec3 unpack_unit_vector(uint packed) { return from_octahedron(unpackSnorm2x16(packed)); }

#endif
