// The texels of last frame among which a pixel's surface is looked for.
#ifndef LIGHTWELL_HISTORY_TAPS_GLSL
#define LIGHTWELL_HISTORY_TAPS_GLSL

// Taps 0 to 3: the four texels round the place, with bilinear weights. Taps 4 to 12: the 3x3 texels round it, with
// weight 1; they count only where hardly any of the four is valid.
const uint kBilinearTaps = 4;
const uint kNeighbourTaps = 9;

// A texel of the reprojection image: bit i says that tap i is valid, one more that neighbours were tried.
const uint kTapMask = (1u << (kBilinearTaps + kNeighbourTaps)) - 1u;
const uint kBorrowedBit = 1u << (kBilinearTaps + kNeighbourTaps);

// Where a pixel's surface was last frame.
struct LastPlace {
  vec2 position;  // pixels from the upper left corner
  bool still;     // it did not move: tap 0 is the pixel itself, since to interpolate again and again would blur
};

struct HistoryTap {
  ivec2 texel;
  float weight;
};

LastPlace last_place(ivec2 pixel, vec2 moved) {
  const float kStill = 1.0 / 16.0;  // pixels
  bool still = all(lessThan(abs(moved), vec2(kStill)));
  return LastPlace(vec2(pixel) + 0.5 - (still ? vec2(0.0) : moved), still);
}

HistoryTap bilinear_tap(LastPlace place, uint tap) {
  vec2 corner = place.still ? floor(place.position) : floor(place.position - 0.5);
  vec2 part = place.still ? vec2(0.0) : place.position - 0.5 - corner;
  ivec2 step = ivec2(tap & 1u, tap >> 1);
  vec2 weights = mix(1.0 - part, part, vec2(step));
  return HistoryTap(ivec2(corner) + step, weights.x * weights.y);
}

HistoryTap neighbour_tap(LastPlace place, uint neighbour) {
  return HistoryTap(ivec2(floor(place.position)) + ivec2(neighbour % 3, neighbour / 3) - 1, 1.0);
}

HistoryTap history_tap(LastPlace place, uint tap) {
  return tap < kBilinearTaps ? bilinear_tap(place, tap) : neighbour_tap(place, tap - kBilinearTaps);
}

#endif
