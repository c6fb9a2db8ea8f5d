#include "passes/noise_filter/still_frames.h"

#include <algorithm>

namespace lightwell {
namespace {

// Frames that a history counts for while light or geometry changes: it lags by as many.
constexpr float kMostFramesInChange = 8.0f;

// With 16 frames: what was before the change fades to (8 9 10 11) / (24 25 26 27) = 2 %, and with the mean that follows
// to 0.5 % after 64 frames.
constexpr float kBlendFactorWhileFading = 4.0f;

}  // namespace

void StillFrames::note(const ViewFrame& frame) {
  const bool reset = frame.is_cut();
  const SceneRevisions& now = frame.world.revisions;
  const bool changed = !reset && (surfaces_changed(revisions_, now) || revisions_.environment != now.environment ||
                                  (settings_.sees_lights && revisions_.lights != now.lights));
  const bool moved = frame.camera.steady_view_projection != view_;
  steady_ = reset || changed || moved ? 0 : steady_ + 1;
  still_ = changed ? 0 : reset ? first() : std::min(still_ + 1, settings_.fading_frames + 1);
  revisions_ = now;
  view_ = frame.camera.steady_view_projection;
}

void StillFrames::note_no_history() {
  steady_ = 0;
  still_ = first();
}

TemporalBlend StillFrames::blend() const {
  if (still_ == 0) return {.most_frames = kMostFramesInChange};
  if (still_ < settings_.fading_frames) return {.blend_factor = kBlendFactorWhileFading};
  if (still_ == settings_.fading_frames) return {.most_frames = static_cast<float>(settings_.fading_frames)};
  return {};
}

}  // namespace lightwell
