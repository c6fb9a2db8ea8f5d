// Alpha masks, without the driver's filter: its last bits differ from device to device, and a mask turns them into holes.
#ifndef LIGHTWELL_ALPHA_MASK_GLSL
#define LIGHTWELL_ALPHA_MASK_GLSL

#include "shaders/material.glsl"

// Alpha of a texel of the finest mip.
float fetch_alpha(uint slot, ivec2 texel) {
  ivec3 place = ivec3(texel, int(slot & 0xffffu));
  uint array = slot >> 16;
  if ((kTextureArrays & 1u) != 0 && array == 0) return texelFetch(textures_0, place, 0).a;
  if ((kTextureArrays & 2u) != 0 && array == 1) return texelFetch(textures_1, place, 0).a;
  if ((kTextureArrays & 4u) != 0 && array == 2) return texelFetch(textures_2, place, 0).a;
  if ((kTextureArrays & 8u) != 0 && array == 3) return texelFetch(textures_3, place, 0).a;
  return 1.0;
}

// Into [0, 1] by wrap modes of lightwell/scene.h: 0 repeat, 1 mirrored repeat, 2 clamp to edge.
float wrapped(float x, uint mode) {
  float period = x - 2.0 * floor(x * 0.5);
  if (mode == 0) return x - floor(x);
  return mode == 1 ? (period > 1.0 ? 2.0 - period : period) : clamp(x, 0.0, 1.0);
}

// Beyond the edge: the other side where the texture repeats, else the edge.
int wrapped_texel(int i, int side, uint mode) { return mode == 0 ? (i + side) % side : clamp(i, 0, side - 1); }

// Bilinear, or the nearest texel where the material says so.
float mask_alpha(GpuMaterial material, vec4 color, vec4 uv) {
  uint slot = material.base_texture;
  float factor = color.a * material.base_color.a;
  if (slot == kNoTexture) return factor;
  vec4 row_0 = material.base_transform_0;
  vec4 row_1 = material.base_transform_1;
  uint flags = uint(row_0.w);
  uint wrap_u = (flags >> 1) & 3u;
  uint wrap_v = (flags >> 3) & 3u;
  vec2 source = (flags & 1u) != 0 ? uv.zw : uv.xy;
  float side = array_side(slot);
  int last = int(side) - 1;
  vec2 t = vec2(wrapped(dot(row_0.xy, source) + row_0.z, wrap_u), wrapped(dot(row_1.xy, source) + row_1.z, wrap_v));
  bool nearest = (flags & 32u) != 0;
  vec2 texels = texture_texels(row_1);
  vec2 place = side * (nearest ? (floor(t * texels) + 0.5) / texels : t);
  vec2 corner = nearest ? floor(place) : floor(place - 0.5);
  vec2 part = nearest ? vec2(0.0) : place - 0.5 - corner;
  ivec2 low = ivec2(wrapped_texel(int(corner.x), last + 1, wrap_u), wrapped_texel(int(corner.y), last + 1, wrap_v));
  ivec2 high = ivec2(wrapped_texel(int(corner.x) + 1, last + 1, wrap_u), wrapped_texel(int(corner.y) + 1, last + 1, wrap_v));
  float upper = (1.0 - part.x) * fetch_alpha(slot, low) + part.x * fetch_alpha(slot, ivec2(high.x, low.y));
  float lower = (1.0 - part.x) * fetch_alpha(slot, ivec2(low.x, high.y)) + part.x * fetch_alpha(slot, high);
  return factor * ((1.0 - part.y) * upper + part.y * lower);
}

#endif
