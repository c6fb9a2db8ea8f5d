// The visible surface that light is gathered at. Needs shaders/trace.glsl.
#ifndef LIGHTWELL_RECEIVER_GLSL
#define LIGHTWELL_RECEIVER_GLSL

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

// Density cos / pi about the shading normal; the square becomes a disk with little distortion (Shirley and Chiu 1997),
// and its points are lifted to the hemisphere (Malley's method).
vec3 cosine_direction(Receiver receiver, vec2 u) {
  vec2 p = 2.0 * u - 1.0;
  bool wide = abs(p.x) > abs(p.y);
  float radius = wide ? p.x : p.y;
  float ratio = (wide ? p.y : p.x) / (radius != 0.0 ? radius : 1.0);
  float angle = 0.785398163397448 * ratio;
  vec2 disk = radius * (wide ? vec2(cos(angle), sin(angle)) : vec2(sin(angle), cos(angle)));

  // A frame about the normal (Duff et al. 2017).
  vec3 n = receiver.normal;
  float side = n.z < 0.0 ? -1.0 : 1.0;
  float a = -1.0 / (side + n.z);
  float b = n.x * n.y * a;
  vec3 x_axis = vec3(1.0 + side * n.x * n.x * a, side * b, -side * n.x);
  vec3 y_axis = vec3(b, side + n.y * n.y * a, -n.y);
  return normalize(disk.x * x_axis + disk.y * y_axis + sqrt(max(0.0, 1.0 - dot(disk, disk))) * n);
}

#endif
