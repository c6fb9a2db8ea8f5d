// Playing of a scene's animations.
#pragma once

#include "lightwell/scene.h"

namespace lightwell {

// Time of the last key, in seconds; 0 without channels.
float animation_end(const Animation& animation);

// Sets the animated nodes' transforms and morph weights to their state at `seconds`. Before the first key of a channel
// its first value holds, after the last its last (glTF 2.0, 3.11); to loop, pass the time modulo animation_end().
// `animation` must have passed validate() as a part of `scene`.
void apply_animation(Scene& scene, const Animation& animation, float seconds);

}  // namespace lightwell
