#include "apps/cli/statistics.h"

#include <cstdio>

#include <nlohmann/json.hpp>

namespace lightwell {

namespace {

std::uint64_t total_memory(const RenderStatistics& statistics) {
  std::uint64_t sum = 0;
  for (const auto& [name, bytes] : statistics.memory_bytes) sum += bytes;
  return sum;
}

template <class... Values>
std::string line(const char* format, Values... values) {
  char text[200];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

}  // namespace

std::string statistics_as_json(const RenderStatistics& statistics, const std::string& device) {
  nlohmann::ordered_json json = {{"device", device},
                                 {"frames", statistics.frames},
                                 {"steady", statistics.steady},
                                 {"gpu_time_ms", statistics.gpu_time_ms},
                                 {"wall_time_ms", statistics.wall_time_ms},
                                 {"triangles", statistics.triangles},
                                 {"vertices", statistics.vertices},
                                 {"lights", statistics.lights},
                                 {"memory_bytes", statistics.memory_bytes}};
  for (const PassStatistics& pass : statistics.passes)
    json["passes"].push_back(
        {{"name", pass.name}, {"time_ms", pass.time_ms}, {"count", pass.count}, {"frames", pass.frames}});
  return json.dump(2);
}

std::string statistics_as_text(const RenderStatistics& statistics, const std::string& device) {
  std::string text = line("%s: %d frames, %.2f ms of GPU time each, %.1f MiB\n", device.c_str(), statistics.frames,
                          statistics.gpu_time_ms, static_cast<double>(total_memory(statistics)) / (1 << 20));
  text += line("%-36s %10s %6s %7s\n", "pass", "ms", "count", "frames");
  for (const PassStatistics& pass : statistics.passes)
    text += line("%-36.36s %10.3f %6u %7d\n", pass.name.c_str(), pass.time_ms, pass.count, pass.frames);
  text += line("%-36s %10s\n", "memory", "MiB");
  for (const auto& [name, bytes] : statistics.memory_bytes)
    text += line("%-36.36s %10.3f\n", name.c_str(), static_cast<double>(bytes) / (1 << 20));
  return text;
}

}  // namespace lightwell
