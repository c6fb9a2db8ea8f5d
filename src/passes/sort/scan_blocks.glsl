// Prefix sums, second half: replaces every element of `blocks` by the sum of those before it. The including kernel, one
// workgroup of 256 x 1 x 1, declares
//   layout(set = 0, binding = n) buffer BlockBuffer { uvec2 data[]; } blocks;
#ifndef LIGHTWELL_SCAN_BLOCKS_GLSL
#define LIGHTWELL_SCAN_BLOCKS_GLSL

shared uvec2 scan_part[256];

// Returns the sum of all.
uvec2 scan_blocks(uint count) {
  uint local = gl_LocalInvocationID.x;
  uint each = (count + 255) / 256;
  uint first = min(local * each, count);
  uint end = min(first + each, count);
  uvec2 sum = uvec2(0);
  for (uint i = first; i < end; ++i) sum += blocks.data[i];
  scan_part[local] = sum;
  barrier();
  if (local == 0) {
    uvec2 before = uvec2(0);
    for (uint i = 0; i < 256; ++i) {
      uvec2 part = scan_part[i];
      scan_part[i] = before;
      before += part;
    }
  }
  barrier();
  uvec2 running = scan_part[local];
  for (uint i = first; i < end; ++i) {
    uvec2 element = blocks.data[i];
    blocks.data[i] = running;
    running += element;
  }
  scan_part[local] = running;
  barrier();
  return scan_part[255];
}

#endif
