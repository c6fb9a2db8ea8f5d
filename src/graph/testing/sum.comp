#version 450
// Adds up an image's red channel, times 4, in fixed point: a reader of what a raster pass wrote.
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D image;
layout(set = 0, binding = 1) buffer Sum { uint value; } sum;

void main() {
  if (all(lessThan(ivec2(gl_GlobalInvocationID.xy), textureSize(image, 0))))
    atomicAdd(sum.value, uint(texelFetch(image, ivec2(gl_GlobalInvocationID.xy), 0).r * 4.0 + 0.5));
}
