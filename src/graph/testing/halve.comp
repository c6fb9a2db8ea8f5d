#version 450
// One mip from the one before it: the mean of 2x2 texels.
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D finer;
layout(set = 0, binding = 1, r32f) uniform writeonly image2D coarser;

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, imageSize(coarser)))) return;
  float sum = 0.0;
  for (int i = 0; i < 4; ++i) sum += texelFetch(finer, 2 * texel + ivec2(i & 1, i >> 1), 0).r;
  imageStore(coarser, texel, vec4(0.25 * sum));
}
