// Frames that are recorded one by one and timed, with nothing brought back from the device.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "apps/cli/render_methods.h"
#include "lightwell/renderer.h"

namespace lightwell {

constexpr int kMaximumBenchFrames = 100000;

// Which measured frames start from nothing, as after a camera cut.
enum class BenchCut { kNone, kFirst, kEvery };

struct BenchRun {
  int frames = 1;
  int warm_up = 0;  // frames before, not measured: drivers compile in them
  BenchCut cut = BenchCut::kNone;
  std::size_t moving_lights = 0;  // the first so many circle by 5 % of the scene's diagonal, suns tilt; at most all
};

struct FrameCost {
  double wall_ms = 0.0;  // declare, record, submit, wait
  RenderStatistics statistics;
};

struct BenchResult {
  std::string device, driver;
  std::vector<FrameCost> frames;  // without those of the warm-up
};

// Throws InputError, also where the validation layer has something to say.
BenchResult run_frames(const RenderJob& job, const BenchRun& run, const std::string& technique);

// Times of the frames and of every pass (least, median, mean, largest, and each), memory, counts. A pass that some
// frames lack took no time in those: the means add up to the frame's.
nlohmann::ordered_json bench_as_json(const BenchResult& result);

}  // namespace lightwell
