// The samples of a picture. The kernel declares params.samples.
#ifndef LIGHTWELL_SPLAT_SAMPLES_GLSL
#define LIGHTWELL_SPLAT_SAMPLES_GLSL

ivec2 sample_count() { return (ivec2(params.samples.size) - 1) / int(params.samples.stride) + 1; }

ivec2 sample_turn() { return ivec2(params.samples.turn & 0xffu, params.samples.turn >> 8); }

// Blocks at the picture's rim may have lost the pixel whose turn it is.
ivec2 pixel_of_sample(ivec2 i) {
  return min(i * int(params.samples.stride) + sample_turn(), ivec2(params.samples.size) - 1);
}

#endif
