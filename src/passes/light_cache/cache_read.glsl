// What the cache says of a face. The including kernel declares
//   layout(set = 0, binding = n) readonly buffer ShownBuffer { vec4 data[]; } shown;
//   layout(set = 0, binding = n) readonly buffer IndirectBuffer { vec4 data[]; } indirect;  // w: 0 where nothing is known
#ifndef LIGHTWELL_CACHE_READ_GLSL
#define LIGHTWELL_CACHE_READ_GLSL

layout(constant_id = 3) const bool kFromLights = false;

vec4 source_of(uint face) { return shown.data[face * kShownWords + kShownSource]; }
vec3 near_of(uint face) { return shown.data[face * kShownWords + kShownNear].rgb; }

// Radiosity (W/m^2) of a surface of this albedo.
vec3 cached_radiosity(uint face, vec3 albedo) {
  vec3 source = source_of(face).rgb;
  vec3 bounced = indirect.data[face].rgb;
  return kFromLights ? source + albedo * bounced : albedo * (source + bounced);
}

#endif
