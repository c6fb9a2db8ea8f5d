// Light by the bounce that brought it, and what a limit on bounces leaves out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lightwell {

class BounceEnergy {
 public:
  // A path reaches a surface, the visible one being bounce 0, and lets this part of the light through.
  void arrive(int bounce, double throughput);
  // Light that the surface of this bounce sends on towards the camera.
  void add(int bounce, double energy);
  void merge(const BounceEnergy& other);

  // Estimate of the share of all light, `other` included, that comes from bounces beyond `limit`: from there on light
  // falls as what the last paths let through. 0 where paths are too few to tell.
  double share_beyond(int limit, double other) const;

 private:
  struct Bounce {
    std::int64_t paths = 0;
    double throughput = 0.0;
    double energy = 0.0;
  };
  Bounce& at(int bounce);

  std::vector<Bounce> bounces_;
};

}  // namespace lightwell
