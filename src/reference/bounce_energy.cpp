#include "reference/bounce_energy.h"

#include <algorithm>
#include <cmath>

namespace lightwell {
namespace {

constexpr std::int64_t kEnoughPaths = 1000;  // that a bounce is judged by

}  // namespace

BounceEnergy::Bounce& BounceEnergy::at(int bounce) {
  const auto index = static_cast<std::size_t>(bounce);
  if (bounces_.size() <= index) bounces_.resize(index + 1);
  return bounces_[index];
}

void BounceEnergy::arrive(int bounce, double throughput) {
  ++at(bounce).paths;
  at(bounce).throughput += throughput;
}

void BounceEnergy::add(int bounce, double energy) {
  at(bounce).energy += energy;
}

void BounceEnergy::merge(const BounceEnergy& other) {
  for (std::size_t i = 0; i < other.bounces_.size(); ++i) {
    Bounce& bounce = at(static_cast<int>(i));
    bounce.paths += other.bounces_[i].paths;
    bounce.throughput += other.bounces_[i].throughput;
    bounce.energy += other.bounces_[i].energy;
  }
}

// Two windows of `width` bounces up to the last that enough paths reached: the later one over the earlier one is the
// ratio of a geometric series, which goes on.
double BounceEnergy::share_beyond(int limit, double other) const {
  std::size_t count = 0;
  while (count < bounces_.size() && count <= static_cast<std::size_t>(limit) && bounces_[count].paths >= kEnoughPaths)
    ++count;
  if (count < 2) return 0.0;
  const std::size_t width = std::max<std::size_t>(1, count / 4);
  double earlier = 0.0, later = 0.0, energy = 0.0;
  for (std::size_t i = count - width; i < count; ++i) {
    earlier += bounces_[i - width].throughput;
    later += bounces_[i].throughput;
    energy += bounces_[i].energy;
  }
  double total = other;
  for (const Bounce& bounce : bounces_) total += bounce.energy;
  if (!(energy > 0.0) || !(later > 0.0) || !std::isfinite(total)) return 0.0;
  if (later >= earlier) return 1.0;
  const double ratio = later / earlier;
  const auto left = static_cast<double>(limit) + 1.0 - static_cast<double>(count);
  const double beyond = energy * ratio / (1.0 - ratio) * std::pow(ratio, left / static_cast<double>(width));
  return beyond / (total + beyond);
}

}  // namespace lightwell
