// Spherical harmonics of two bands, and what diffuse transport needs of them.
//
// A function on the sphere is four coefficients over the real orthonormal basis
//   Y0 = 1 / (2 sqrt(pi)),   Y1 = sqrt(3 / (4 pi)) * (x, y, z)
// in the order (Y0, Y1x, Y1y, Y1z), so that the integral of a product of two functions is the dot product of their
// coefficients. Sign convention: no Condon-Shortley phase.
//
// Only names and operators that GLSL and glm share are used: tests compile this file as C++ and hold every function
// against numerical integration.
#ifndef LIGHTWELL_SHADERS_SH_GLSL
#define LIGHTWELL_SHADERS_SH_GLSL

#include "shaders/constants.glsl"

const float kShY0 = 0.28209479177388f;  // 1 / (2 sqrt(pi))
const float kShY1 = 0.48860251190292f;  // sqrt(3 / (4 pi))

// The basis at a unit direction. Also the projection of a unit impulse there.
vec4 sh_basis(vec3 direction) { return vec4(kShY0, kShY1 * direction); }

// The function's value in a unit direction.
float sh_evaluate(vec4 sh, vec3 direction) { return dot(sh, sh_basis(direction)); }

// Its integral over the sphere: only the constant band contributes, and Y0 * 4 pi = 1 / Y0.
float sh_integral(vec4 sh) { return sh.x / kShY0; }

// A function that depends only on t = cos(angle to `axis`): its projection needs the two moments over the sphere
// m0 = integral f dw and m1 = integral f t dw; components across the axis vanish by symmetry.
vec4 sh_lobe(vec3 axis, float m0, float m1) { return vec4(kShY0 * m0, (kShY1 * m1) * axis); }

// 1 on the hemisphere about `axis`, 0 elsewhere: m0 = 2 pi, m1 = 2 pi * integral_0^1 t dt = pi.
vec4 sh_hemisphere(vec3 axis) { return sh_lobe(axis, 2.0f * kPi, kPi); }

// max(0, t): m0 = 2 pi * integral_0^1 t dt = pi, m1 = 2 pi * integral_0^1 t^2 dt = 2 pi / 3.
// (Sloan 2008, "Stupid spherical harmonics tricks", gives the same for all bands.)
vec4 sh_cosine_lobe(vec3 axis) { return sh_lobe(axis, kPi, 2.0f * kPi / 3.0f); }

// 1 where a ray from the centre of a cube leaves through the face along `axis`, 0 elsewhere. One face of six:
// m0 = 4 pi / 6. m1 is Lambert's vector irradiance of a polygon, 1/2 sum over edges of (angle of the edge) * (normal of
// the plane through edge and centre): the face's corners are (+-1, +-1, 1), so each of its four edges spans
// acos(1/3), and its plane's normal has 1/sqrt(2) along the axis: m1 = sqrt(2) * acos(1/3).
const float kShFaceSolidAngle = 2.09439510239320f;  // 2 pi / 3 sr
const float kShFaceMoment = 1.74083950273421f;      // sqrt(2) * acos(1/3)
vec4 sh_cube_face(vec3 axis) { return sh_lobe(axis, kShFaceSolidAngle, kShFaceMoment); }

#endif
