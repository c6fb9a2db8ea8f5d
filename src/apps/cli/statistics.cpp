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

std::string first_frame_as_text(const FirstFrame& first) {
  return line("first frame: setup %.1f ms, declare %.1f ms, %u pipelines %.1f ms, record %.1f ms, wait %.1f ms\n",
              first.setup_ms, first.declare_ms, first.pipelines, first.pipelines_ms, first.record_ms, first.wait_ms);
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
  const FirstFrame& first = statistics.first_frame;
  json["first_frame"] = {{"setup_ms", first.setup_ms},         {"declare_ms", first.declare_ms},
                         {"pipelines_ms", first.pipelines_ms}, {"pipelines", first.pipelines},
                         {"record_ms", first.record_ms},       {"wait_ms", first.wait_ms}};
  for (const PassStatistics& pass : statistics.passes)
    json["passes"].push_back(
        {{"name", pass.name}, {"time_ms", pass.time_ms}, {"count", pass.count}, {"frames", pass.frames}});
  return json.dump(2);
}

std::string statistics_as_text(const RenderStatistics& statistics, const std::string& device) {
  std::string text = line("%s: %d frames, %.2f ms of GPU time each, %.1f MiB\n", device.c_str(), statistics.frames,
                          statistics.gpu_time_ms, static_cast<double>(total_memory(statistics)) / (1 << 20));
  text += first_frame_as_text(statistics.first_frame);
  text += line("%-36s %10s %6s %7s\n", "pass", "ms", "count", "frames");
  for (const PassStatistics& pass : statistics.passes)
    text += line("%-36.36s %10.3f %6u %7d\n", pass.name.c_str(), pass.time_ms, pass.count, pass.frames);
  text += line("%-36s %10s\n", "memory", "MiB");
  for (const auto& [name, bytes] : statistics.memory_bytes)
    text += line("%-36.36s %10.3f\n", name.c_str(), static_cast<double>(bytes) / (1 << 20));
  return text;
}

}  // namespace lightwell
