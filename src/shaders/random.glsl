// Numbers in [0,1)^2 that are spread evenly: over the frames of a pixel, and over neighbouring pixels of a frame.
#ifndef LIGHTWELL_RANDOM_GLSL
#define LIGHTWELL_RANDOM_GLSL

// A well-mixed function of one word (Wellons 2018, "lowbias32").
uint hash_word(uint x) {
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

// Owen's nested uniform scrambling of a number whose bits are reversed: each bit is flipped by a hash of the lower ones
// (Laine and Karras 2011, Sec. 3.1; constants: Vegdahl 2021).
uint scramble_reversed(uint x, uint seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

// A sequence in another order: every aligned block of 2^k indices becomes another one, its own order scrambled likewise.
// Two sequences with the same index are independent only in different orders (Burley 2020, Sec. 4): otherwise the lowest
// bit of the index, say, would decide the half in which both their points lie.
uint shuffled_index(uint index, uint seed) {
  return bitfieldReverse(scramble_reversed(bitfieldReverse(index), seed));
}

// Point `index` of Sobol's first two dimensions, the (0,2)-sequence (Sobol 1967), bits reversed: bit 0 counts halves.
uvec2 sobol_reversed(uint index) {
  // The second dimension is Pascal's matrix modulo 2 times the index, 2^k rows a step.
  uint y = bitfieldReverse(index);
  y ^= (y << 1) & 0xaaaaaaaau;
  y ^= (y << 2) & 0xccccccccu;
  y ^= (y << 4) & 0xf0f0f0f0u;
  y ^= (y << 8) & 0xff00ff00u;
  y ^= (y << 16) & 0xffff0000u;
  return uvec2(index, bitfieldReverse(y));
}

// Point `index` of the sequence of a pixel; different `set`s are independent.
//  * Along `index` it is an Owen-scrambled (0,2)-sequence: any 2^k consecutive points from a multiple of 2^k on are
//    stratified in every way at once, which beats random points by more than sqrt(n) (Owen 1997; Kollig and Keller 2002).
//  * The 16 pixels of a 4x4 block xor their sequences with the 16 first points of Sobol's: for one `index` each has a cell
//    of 4x4 to itself, so neighbours complement each other before any filter (interleaved sampling, Keller and Heidrich
//    2001). Below these two bits every pixel scrambles by itself: with more bits in common, the mean of 16 frames has
//    errors in blocks (correlation 0.4 instead of 0).
vec2 stratified_point(uvec2 pixel, uint index, uint set) {
  uvec2 block = pixel >> 2;
  uint block_seed = hash_word(block.x ^ hash_word(block.y ^ hash_word(set)));
  uvec2 inside = pixel & 3u;
  // Neighbours far apart in the set: the order of Morton's curve.
  uint rank = (inside.x & 1u) | ((inside.y & 1u) << 1) | ((inside.x & 2u) << 1) | ((inside.y & 2u) << 2);
  index = shuffled_index(index, hash_word(block_seed ^ 0x68bc21ebu));
  uvec2 point = sobol_reversed(index) ^ sobol_reversed(rank) ^ uvec2(block_seed & 3u, (block_seed >> 2) & 3u);
  uint seed = hash_word(block_seed + rank);
  uvec2 scrambled = uvec2(scramble_reversed(point.x, seed), scramble_reversed(point.y, hash_word(seed)));
  uvec2 digits = bitfieldReverse((point & 3u) | (scrambled & ~3u));
  return vec2(digits >> 8) * (1.0 / 16777216.0);
}

// Point `index` of a sequence of any number of dimensions, two a `set`: Owen-scrambled (0,2)-sequences, each in an order
// of its own (padding, Burley 2020, Sec. 5). The order keeps blocks of 2^k indices from a multiple of 2^k on together.
vec2 padded_point(uint index, uint set) {
  uint seed = hash_word(set + 0x9e3779b9u);
  uvec2 point = sobol_reversed(shuffled_index(index, seed));
  uvec2 digits = bitfieldReverse(uvec2(scramble_reversed(point.x, hash_word(seed ^ 1u)),
                                       scramble_reversed(point.y, hash_word(seed ^ 2u))));
  return vec2(digits >> 8) * (1.0 / 16777216.0);
}

// Point `index` of the van der Corput sequence in `base`, 2 at least (Halton 1960).
float radical_inverse(uint base, uint index) {
  float scale = 1.0;
  float sum = 0.0;
  for (int digit = 0; digit < 32 && index > 0; ++digit) {
    uint rest = index / base;
    scale /= float(base);
    sum += float(index - rest * base) * scale;
    index = rest;
  }
  return min(sum, 0.99999994);
}

#endif
