#include "apps/cli/bench_tables.h"

#include <algorithm>
#include <cmath>

#include <CLI/CLI.hpp>

#include "apps/cli/text.h"

namespace lightwell {

std::vector<double> stage_times(const FrameCost& frame, const std::vector<Stage>& stages) {
  std::vector<double> times(stages.size(), 0.0);
  for (const PassStatistics& pass : frame.statistics.passes) {
    const auto stage = std::find_if(stages.begin(), stages.end() - 1, [&](const Stage& candidate) {
      return std::any_of(candidate.passes.begin(), candidate.passes.end(),
                         [&](const std::string& name) { return pass.name.starts_with(name); });
    });
    times[static_cast<std::size_t>(stage - stages.begin())] += pass.time_ms;
  }
  return times;
}

const FrameCost& fastest_frame(const BenchResult& result) {
  return *std::min_element(result.frames.begin(), result.frames.end(), [](const FrameCost& a, const FrameCost& b) {
    return a.statistics.gpu_time_ms < b.statistics.gpu_time_ms;
  });
}

int scaled_side(int side, float scale) {
  return std::max(1, static_cast<int>(std::lround(scale * static_cast<float>(side))));
}

std::string scaled_size(std::string_view size, float scale) {
  const glm::ivec2 sides = parse_size("--size", size);
  return std::to_string(scaled_side(sides.x, scale)) + "x" + std::to_string(scaled_side(sides.y, scale));
}

void refuse_options_of_bench(const CLI::App& bench, const CLI::App& command) {
  for (const CLI::Option* option : bench.get_options())
    if (!option->empty()) throw CLI::ExtrasError(command.get_name(), {option->get_name()});
}

}  // namespace lightwell
