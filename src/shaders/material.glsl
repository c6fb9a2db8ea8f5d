// Materials and their textures: bindings 2 to 6 of set 1, the scene's (GpuScene::Frame::set).
// `uv` holds two pairs of texture coordinates: xy of the base colour, zw of the emission. `uv_dx`, `uv_dy` are its changes over the sample's
// footprint: dFdx/dFdy in a fragment shader, the change over one cell for a voxel, 0 for the finest mip.
#ifndef LIGHTWELL_MATERIAL_GLSL
#define LIGHTWELL_MATERIAL_GLSL

#include "passes/gpu_scene/gpu_scene_types.h"

layout(set = 1, binding = 2) readonly buffer SceneMaterialBuffer { GpuMaterial data[]; } materials;
// Four bindings: the baseline device cannot choose among images per pixel.
layout(set = 1, binding = 3) uniform sampler2DArray textures_0;
layout(set = 1, binding = 4) uniform sampler2DArray textures_1;
layout(set = 1, binding = 5) uniform sampler2DArray textures_2;
layout(set = 1, binding = 6) uniform sampler2DArray textures_3;

GpuMaterial scene_material(uint index) { return materials.data[index]; }

// Which of the arrays hold what (Frame::texture_arrays): bits 0 to 3 base colours, bits 4 to 7 emission. Whoever sets it
// spares the device the code for the others.
layout(constant_id = 10) const uint kTextureArrays = 0xffu;

// Wrap modes as in lightwell/scene.h: 0 repeat, 1 mirrored repeat, 2 clamp to edge. The sampler repeats; the others are
// brought into [0,1] here, half a texel away from the far edge where clamped.
float wrap_coordinate(float x, uint mode, float half_texel) {
  if (mode == 1) {
    float t = x - 2.0 * floor(x * 0.5);
    x = t > 1.0 ? 2.0 - t : t;
  }
  return mode == 0 ? x : clamp(x, half_texel, 1.0 - half_texel);
}

vec4 sample_array(uint arrays, uint slot, vec2 uv, vec2 dx, vec2 dy) {
  float layer = float(slot & 0xffffu);
  uint array = slot >> 16;
  if ((arrays & 1u) != 0 && array == 0) return textureGrad(textures_0, vec3(uv, layer), dx, dy);
  if ((arrays & 2u) != 0 && array == 1) return textureGrad(textures_1, vec3(uv, layer), dx, dy);
  if ((arrays & 4u) != 0 && array == 2) return textureGrad(textures_2, vec3(uv, layer), dx, dy);
  if ((arrays & 8u) != 0 && array == 3) return textureGrad(textures_3, vec3(uv, layer), dx, dy);
  return vec4(1.0);
}

float array_side(uint slot) {
  switch (slot >> 16) {
    case 0: return float(textureSize(textures_0, 0).x);
    case 1: return float(textureSize(textures_1, 0).x);
    case 2: return float(textureSize(textures_2, 0).x);
    default: return float(textureSize(textures_3, 0).x);
  }
}

// The texels that a texture had before it was brought to the side of its array, from the second row of its transform.
vec2 texture_texels(vec4 row_1) { return vec2(mod(row_1.w, 4096.0), floor(row_1.w / 4096.0)); }

// Linear RGBA of texture `slot`, in one of `arrays` (4 bits), through the two rows of its transform
// (gpu_scene_types.h); white if there is none.
vec4 sample_texture(uint arrays, uint slot, vec4 row_0, vec4 row_1, vec4 uv, vec4 uv_dx, vec4 uv_dy) {
  if (arrays == 0 || slot == kNoTexture) return vec4(1.0);
  uint flags = uint(row_0.w);
  bool second = (flags & 1u) != 0;
  vec2 source = second ? uv.zw : uv.xy;
  vec2 source_dx = second ? uv_dx.zw : uv_dx.xy;
  vec2 source_dy = second ? uv_dy.zw : uv_dy.xy;

  vec2 t = vec2(dot(row_0.xy, source) + row_0.z, dot(row_1.xy, source) + row_1.z);
  vec2 dx = vec2(dot(row_0.xy, source_dx), dot(row_1.xy, source_dx));
  vec2 dy = vec2(dot(row_0.xy, source_dy), dot(row_1.xy, source_dy));

  float side = array_side(slot);
  vec2 wrapped = vec2(wrap_coordinate(t.x, (flags >> 1) & 3u, 0.5 / side), wrap_coordinate(t.y, (flags >> 3) & 3u, 0.5 / side));
  if ((flags & 32u) != 0) {
    // Without interpolation: in the middle of the texture's own texel, the centre of one of the finest mip.
    vec2 texels = texture_texels(row_1);
    wrapped = (floor(wrapped * texels) + 0.5) / texels;
    wrapped = (floor(wrapped * side) + 0.5) / side;
    dx = dy = vec2(0.0);
  }
  return sample_array(arrays, slot, wrapped, dx, dy);
}

// Base colour: linear albedo in rgb, coverage in a. `color`: of the vertices.
vec4 base_color(GpuMaterial material, vec4 color, vec4 uv, vec4 uv_dx, vec4 uv_dy) {
  return color * material.base_color * sample_texture(kTextureArrays & 15u, material.base_texture, material.base_transform_0,
                                              material.base_transform_1, uv, uv_dx, uv_dy);
}

// The albedo with which caches of light (voxels, what a ray meets) reflect, where the base colour is `base`:
// all of it is diffuse.
vec3 cache_albedo(GpuMaterial material, vec4 base) {
  return base.rgb;
}

// True where an alpha mask leaves a hole.
bool is_hole(GpuMaterial material, float alpha) {
  return alpha < material.alpha_cutoff;
}

// Emitted radiance, W/(sr m^2), towards the front or the back of the surface.
vec3 emitted_radiance(GpuMaterial material, vec4 uv, vec4 uv_dx, vec4 uv_dy, bool front) {
  if (material.emission.xyz == vec3(0.0) || (!front && material.emission.w == 0.0)) return vec3(0.0);
  return material.emission.xyz * sample_texture(kTextureArrays >> 4, material.emission_texture, material.emission_transform_0,
                                                material.emission_transform_1, uv, uv_dx, uv_dy).rgb;
}

#endif
