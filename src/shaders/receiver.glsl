// The visible surface that light is gathered at.
#ifndef LIGHTWELL_RECEIVER_GLSL
#define LIGHTWELL_RECEIVER_GLSL

#include "shaders/ray_start.glsl"

struct Receiver {
  vec3 position;
  vec3 normal;  // shading normal, unit
  vec3 face;    // the triangle's, unit, on the same side
  vec3 start;   // of rays
};

// `place`: position, w distance from the camera. A pixel's position is as good as the rasteriser's interpolation, whose
// error grows with the distance.
Receiver make_receiver(vec4 place, vec3 normal, vec3 face, float clearance) {
  return Receiver(place.xyz, normal, face, ray_start(place.xyz, face) + (clearance * place.w) * face);
}

// Cosine to the shading normal; 0 below the triangle itself, so that interpolated normals let no light through.
float cosine_above(Receiver receiver, vec3 direction) {
  return dot(receiver.face, direction) > 0.0 ? max(0.0, dot(receiver.normal, direction)) : 0.0;
}

#endif
