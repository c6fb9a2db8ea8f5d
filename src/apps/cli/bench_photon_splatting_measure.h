// Measures the settings of photon splatting: error of indirect light over time, and memory.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/ext/vector_int2.hpp>

#include "apps/cli/bench_photon_splatting_settings.h"
#include "apps/cli/bench_photon_splatting_truth.h"
#include "gpu/device.h"

namespace lightwell {

struct SplatBenchArguments {
  glm::ivec2 size{0};
  int bounces = 1;
  int frames = 1;              // of the curve over frames
  int samples = 2;             // paths a pixel of the truth
  float photons_scale = 1.0f;  // factor on all numbers of photons
  std::string conference;      // its file
  std::string device;
  bool validation = false;
};

struct SplatPoint {
  int photons = 0;
  int frames = 1;
  int k = 0;  // of the photon mapper's estimates
  double time_ms =
      0.0;  // the least of some, from nothing; without G-buffer, direct light and what makes a picture of them
  double us_per_query = 0.0;  // of the photon mapper on one core
  IndirectError error;
};

// Bytes, and the photons that they are of.
struct SplatMemory {
  std::int64_t photons = 0;
  std::uint64_t splat_bytes = 0;   // what the picture is made of: splats, or photons and kd-tree
  std::uint64_t photon_bytes = 0;  // the same with all that splats are made from
  std::uint64_t map_bytes = 0;     // shadow maps
  std::uint64_t tile_bytes = 0;    // lists of splats by tiles of the picture, whose limit is an option
};

struct SplatMeasure {
  std::string setting;
  std::vector<SplatPoint> points;
  std::vector<SplatPoint> best_k;  // of the photon mapper: with as many photons as the points, and the k of least RMSE
  SplatMemory memory;
};

class SplatBench {
 public:
  // Loads the scene and traces the truth. Throws InputError.
  SplatBench(const SplatBenchArguments& arguments, const SplatScene& scene, Device& device);

  const IndirectTruth& truth() const { return *truth_; }

  // Throws InputError.
  SplatMeasure measure(const SplatSetting& setting) const;

 private:
  SplatMeasure measure_mapper(const SplatSetting& setting) const;
  SplatMeasure measure_frame(const SplatSetting& setting) const;
  SplatMeasure measure_frames(const SplatSetting& setting) const;
  RendererOptions options_of(const SplatSetting& setting, int photons) const;
  int scaled(int photons) const;

  const SplatBenchArguments& arguments_;
  Device& device_;
  Scene scene_;
  Moment moment_;
  std::unique_ptr<IndirectTruth> truth_;
};

// How long `best` took until its error was that of the photon mapper.
struct EqualError {
  SplatPoint mapper;
  std::string setting;            // of `best`, that was there first
  std::optional<double> time_ms;  // between two of the points; none: the error is not reached
  bool at_most = false;           // the first point is below already
  double ratio() const { return *time_ms / mapper.time_ms; }
};

// Of some settings of `best`, the fastest for each point of the mapper.
std::vector<EqualError> equal_errors(const SplatMeasure& mapper, const std::vector<const SplatMeasure*>& bests);

}  // namespace lightwell
