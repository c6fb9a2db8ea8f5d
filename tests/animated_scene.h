// The built-in animated scene, frame by frame.
#pragma once

#include <string>

#include <glm/trigonometric.hpp>

#include "lightwell/scene.h"
#include "scene/builtin.h"

namespace lightwell {

class AnimatedScene {
 public:
  const Scene& scene() const { return scene_; }

  // Frame 0 to 47 of a loop of two seconds.
  SceneSnapshot frame(int index) const {
    constexpr float kFramesPerSecond = 24.0f;
    const float seconds = static_cast<float>(index) / kFramesPerSecond;
    return take_snapshot(scene_, animate_nodes(scene_, scene_.animations.at(0), seconds));
  }

 private:
  Scene scene_ = load_scene(resolve_scene("cornell-dynamic"));
};

}  // namespace lightwell
