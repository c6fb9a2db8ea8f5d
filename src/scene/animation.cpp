#include <algorithm>
#include <span>

#include <glm/gtc/quaternion.hpp>

#include "lightwell/scene.h"

namespace lightwell {

namespace {

// The two keys around a moment, and how far between them it is.
struct KeySpan {
  std::size_t before = 0;
  std::size_t after = 0;
  double fraction = 0.0;  // [0,1]
  double duration = 0.0;  // seconds
};

KeySpan find_keys(const std::vector<float>& times, float seconds) {
  const auto next = std::upper_bound(times.begin(), times.end(), seconds);
  if (next == times.begin()) return {};
  const auto before = static_cast<std::size_t>(next - times.begin()) - 1;
  if (next == times.end()) return {before, before, 0.0, 0.0};
  const double duration = static_cast<double>(*next) - times[before];
  return {before, before + 1, (static_cast<double>(seconds) - times[before]) / duration, duration};
}

// The part of a cubic spline key that is meant: tangents of both sides surround the value (glTF 2.0, appendix C).
enum class SplinePart : std::size_t { kInTangent, kValue, kOutTangent };

std::vector<float> as_floats(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

// One channel's numbers at one moment, before rotations are normalised. In double precision: far from 0 the way
// between two keys is longer than single precision can tell its places apart.
class ChannelSampler {
 public:
  ChannelSampler(const AnimationChannel& channel, float seconds)
      : channel_(channel), keys_(find_keys(channel.times, seconds)) {
    is_spline_ = channel.interpolation == Interpolation::kCubicSpline;
    width_ = channel.values.size() / channel.times.size() / (is_spline_ ? 3 : 1);
  }

  std::vector<double> sample() const {
    std::vector<double> result(width_);
    const std::span<const float> a = key(keys_.before, SplinePart::kValue);
    const std::span<const float> b = key(keys_.after, SplinePart::kValue);
    const double t = keys_.fraction;
    for (std::size_t i = 0; i < width_; ++i) {
      if (channel_.interpolation == Interpolation::kStep) {
        result[i] = a[i];
      } else if (is_spline_) {
        const double out = keys_.duration * key(keys_.before, SplinePart::kOutTangent)[i];
        const double in = keys_.duration * key(keys_.after, SplinePart::kInTangent)[i];
        result[i] = hermite(a[i], out, b[i], in, t);
      } else {
        result[i] = a[i] + t * (static_cast<double>(b[i]) - a[i]);
      }
    }
    return result;
  }

  glm::quat sample_rotation() const {
    if (channel_.interpolation == Interpolation::kLinear)
      return glm::slerp(as_rotation(key(keys_.before, SplinePart::kValue)),
                        as_rotation(key(keys_.after, SplinePart::kValue)), static_cast<float>(keys_.fraction));
    return as_rotation(as_floats(sample()));
  }

 private:
  std::span<const float> key(std::size_t index, SplinePart part) const {
    const std::size_t vector = is_spline_ ? 3 * index + static_cast<std::size_t>(part) : index;
    return std::span(channel_.values).subspan(vector * width_, width_);
  }

  // Cubic with values a, b and derivatives (per unit of t) da, db at t = 0, 1.
  static double hermite(double a, double da, double b, double db, double t) {
    const double t2 = t * t, t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * a + (t3 - 2 * t2 + t) * da + (3 * t2 - 2 * t3) * b + (t3 - t2) * db;
  }

  static glm::quat as_rotation(std::span<const float> xyzw) {
    const glm::quat q(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
    const float length = glm::length(q);
    return length > 0.0f ? q / length : glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
  }

  const AnimationChannel& channel_;
  KeySpan keys_;
  bool is_spline_ = false;
  std::size_t width_ = 0;
};

}  // namespace

float animation_end(const Animation& animation) {
  float end = 0.0f;
  for (const AnimationChannel& channel : animation.channels) end = std::max(end, channel.times.back());
  return end;
}

std::vector<Node> animate_nodes(const Scene& scene, const Animation& animation, float seconds) {
  std::vector<Node> nodes = scene.nodes;
  for (const AnimationChannel& channel : animation.channels) {
    const ChannelSampler sampler(channel, seconds);
    Node& node = nodes[static_cast<std::size_t>(channel.node)];
    if (channel.path == AnimationPath::kMorphWeights) {
      node.morph_weights = as_floats(sampler.sample());
      continue;
    }
    node.matrix.reset();  // glTF allows no matrix on animated nodes
    if (channel.path == AnimationPath::kRotation) {
      node.rotation = sampler.sample_rotation();
      continue;
    }
    const std::vector<double> xyz = sampler.sample();
    if (channel.path == AnimationPath::kTranslation)
      node.translation = {xyz[0], xyz[1], xyz[2]};
    else
      node.scale = glm::dvec3(xyz[0], xyz[1], xyz[2]);
  }
  return nodes;
}

}  // namespace lightwell
