// Which emitters are found along links and which by shadow rays. The including kernel declares `counts`.
#ifndef LIGHTWELL_SURFEL_NEAR_GLSL
#define LIGHTWELL_SURFEL_NEAR_GLSL

// Distance in cells below which emission comes along links. Small lamps are missed by most links and need
// shadow rays, but the light of a point on one grows with 1 / d^2 close to it. Where an eighth of all surfels emits,
// links miss none.
float near_emitters() {
  return 8 * counts.data[kCountEmitters] > counts.data[kCountSurfels] ? 1e9 : 4.0;
}

#endif
