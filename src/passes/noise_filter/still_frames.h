// How long scene and camera have stayed as they are, and so how a frame and the mean of those before come together.
#pragma once

#include <cstdint>

#include <glm/ext/matrix_float4x4.hpp>

#include "passes/gpu_scene/scene_revisions.h"
#include "passes/noise_filter/noise_filter.h"
#include "passes/view/view_frame.h"

namespace lightwell {

class StillFrames {
 public:
  struct Settings {
    // For so many frames after a change every frame counts more than those before it, so that what was before the
    // change fades with the fourth power of their number.
    std::uint32_t fading_frames = 16;
    bool sees_lights = false;     // a change of point, spot and directional lights is one, too
    bool fades_at_first = false;  // also after the first frame of all: the light arrives over several frames
  };

  explicit StillFrames(const Settings& settings) : settings_(settings), still_(first()) {}

  // Counts what happened since the last frame.
  void note(const ViewFrame& frame);
  // Of the past nothing is left.
  void note_no_history();

  // How this frame and the mean of those before come together.
  TemporalBlend blend() const;
  bool changed() const { return still_ == 0; }  // the scene, in this frame
  // Frames since scene or camera changed.
  std::uint32_t steady() const { return steady_; }

 private:
  std::uint32_t first() const { return settings_.fades_at_first ? 1 : settings_.fading_frames + 1; }

  Settings settings_;
  SceneRevisions revisions_;  // of the scene in the last frame
  glm::mat4 view_{0.0f};      // of the last frame
  std::uint32_t steady_ = 0;
  std::uint32_t still_;  // frames since the scene changed; fading_frames + 1 where its past does not matter
};

}  // namespace lightwell
