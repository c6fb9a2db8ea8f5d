#include "renderer/pass_clock.h"

namespace lightwell {

void PassClock::add_frame(const std::vector<PassTime>& times) {
  double& frames_ms = frames_++ == 0 ? first_frame_ms_ : later_frames_ms_;
  for (const PassTime& time : times) {
    frames_ms += time.time_ms;
    const auto [place, added] = places_.try_emplace(time.name, sums_.size());
    if (added) {
      sums_.push_back({time.name, time.time_ms, 0.0, 0, time.count});
      continue;
    }
    Sum& sum = sums_[place->second];
    sum.later_ms += time.time_ms;
    ++sum.later_frames;
    sum.count = time.count;
  }
}

std::vector<PassStatistics> PassClock::means() const {
  std::vector<PassStatistics> means;
  for (const Sum& sum : sums_) {
    means.push_back({sum.name, sum.later_frames > 0 ? sum.later_ms / sum.later_frames : sum.first_ms, sum.count,
                     sum.later_frames + 1});
  }
  return means;
}

double PassClock::mean_frame_ms() const {
  return frames_ > 1 ? later_frames_ms_ / (frames_ - 1) : first_frame_ms_;
}

}  // namespace lightwell
