#include "apps/cli/memory_check.h"

#include <cstdio>

#include "core/system_memory.h"
#include "gpu/device.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

// Measured as the growth of peak memory from 1024x1024 to 2048x2048 pixels (/usr/bin/time -v lightwell render sphere
// --frames 1 --size ... -o x.exr): 81 B a pixel for --technique path-tracer, 220 for photon-mapping; on lavapipe 396
// for none, 412 for light-volume.
constexpr double kPictureBytes = 81.0;
constexpr double kPhotonMapperBytes = 220.0;
constexpr double kFrameBytes = 412.0;

void check_memory(const glm::ivec2& size, double bytes_per_pixel) {
  constexpr double kGigabyte = 1e9;
  constexpr double kUsable = 0.8;
  const double needed = bytes_per_pixel * size.x * size.y;
  const double limit = static_cast<double>(memory_limit());
  if (needed <= kUsable * limit) return;
  char cause[200];
  std::snprintf(cause, sizeof cause,
                "%dx%d pixels need %.1f GB of memory; of the %.1f GB that are here, %.1f can be used", size.x, size.y,
                needed / kGigabyte, limit / kGigabyte, kUsable * limit / kGigabyte);
  throw InputError("--size", cause);
}

}  // namespace

void check_picture_memory(const glm::ivec2& size) {
  check_memory(size, kPictureBytes);
}

void check_photon_mapper_memory(const glm::ivec2& size) {
  check_memory(size, kPhotonMapperBytes);
}

void check_frame_memory(const glm::ivec2& size, const Device& device) {
  const std::string& type = device.summary().type;
  if (type == "software" || type == "integrated GPU") check_memory(size, kFrameBytes);
}

}  // namespace lightwell
