// A link: what one of a face's rays met. x, low 28 bits: kLinkEscaped, kLinkUnknown, or 1 + the key of the face that it
// met; the rest: albedo there, 12 bits a channel, since light that bounces often multiplies the error (8 bits of albedo
// 0.95 would lose 2 % of a closed box' light). Its slot is the same word x, with where the light of that face is instead:
// kFallenEscaped, kFallenUnknown, or kFallenFaces + the face's slot.
#ifndef LIGHTWELL_CACHE_LINK_GLSL
#define LIGHTWELL_CACHE_LINK_GLSL

uvec2 make_link(uint to, vec3 albedo) {
  uvec3 a = uvec3(clamp(albedo, 0.0, 1.0) * 4095.0 + 0.5);
  return uvec2(to | a.b >> 8 << 28, a.r | a.g << 12 | a.b << 24);
}

uint link_to(uint word) { return word & kLinkUnknown; }

uint lead_to(uint word, uint to) { return (word & ~kLinkUnknown) | to; }

vec3 link_albedo(uvec2 link) {
  return vec3(link.y & 4095u, link.y >> 12 & 4095u, link.y >> 24 | link.x >> 28 << 8) / 4095.0;
}

#endif
