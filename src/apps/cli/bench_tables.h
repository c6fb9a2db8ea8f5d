// What published tables, measured here, share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "apps/cli/bench_frames.h"

namespace CLI {
class App;
}

namespace lightwell {

// A row or column of a table: passes by the beginnings of their names. The last of a list of stages has none and takes
// all passes that no other takes.
struct Stage {
  const char* name;
  std::vector<std::string> passes;
};

// Milliseconds of each stage in a frame.
std::vector<double> stage_times(const FrameCost& frame, const std::vector<Stage>& stages);

// The frame that took the device least.
const FrameCost& fastest_frame(const BenchResult& result);

// At least 1.
int scaled_side(int side, float scale);

// "WIDTHxHEIGHT" of a published size, both sides times `scale`.
std::string scaled_size(std::string_view size, float scale);

// Options of `bench` itself are taken for its own where `command`, one below it, does not have them: throws
// CLI::ExtrasError if there are any.
void refuse_options_of_bench(const CLI::App& bench, const CLI::App& command);

}  // namespace lightwell
