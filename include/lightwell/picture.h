// What a renderer, CPU or GPU, gives back for one frame.
#pragma once

#include "lightwell/image.h"

namespace lightwell {

// All of one size; radiance towards the camera in W/(sr m^2), anti-aliased with a 1 pixel box. Light is split at the
// visible surface: `direct` came straight from a light or emitter, `indirect` bounced at least once between emitter and
// visible surface (albedo included in both), `emission` is what the visible surface emits, or the environment behind
// everything. combined = direct + indirect + emission.
struct Picture {
  Image combined;
  Image direct;
  Image indirect;
  Image emission;
  Image albedo;  // base colour in [0,1], 0 where nothing is seen
  Image normal;  // world space shading normal towards the camera, 0 where nothing is seen
  Image depth;   // distance along the camera's forward axis in metres, 0 where nothing is seen
  // Of the means in `combined`, per channel, as the renderer's own samples tell it: (W/(sr m^2))^2. The path tracer's
  // where it is asked for, from 2 samples on; without pixels where nothing is known.
  Image variance;
};

}  // namespace lightwell
