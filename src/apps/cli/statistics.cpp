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

double bytes_per_photon(const PhotonMapperStatistics& statistics) {
  const auto photons = static_cast<double>(statistics.photons_kept);
  return photons > 0.0 ? static_cast<double>(statistics.photon_bytes + statistics.tree_bytes) / photons : 0.0;
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
                                 {"counts", statistics.counts},
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
  for (const auto& [name, count] : statistics.counts)
    text += line("%-36.36s %10llu\n", name.c_str(), static_cast<unsigned long long>(count));
  text += line("%-36s %10s\n", "memory", "MiB");
  for (const auto& [name, bytes] : statistics.memory_bytes)
    text += line("%-36.36s %10.3f\n", name.c_str(), static_cast<double>(bytes) / (1 << 20));
  return text;
}

std::string statistics_as_json(const PhotonMapperStatistics& statistics) {
  const nlohmann::ordered_json json = {{"threads", statistics.threads},
                                       {"emitted", statistics.emitted},
                                       {"stored", statistics.stored},
                                       {"photons_kept", statistics.photons_kept},
                                       {"emission_ms", statistics.emission_ms},
                                       {"tree_ms", statistics.tree_ms},
                                       {"camera_ms", statistics.camera_ms},
                                       {"query_ms", statistics.query_ms},
                                       {"wall_time_ms", statistics.wall_time_ms},
                                       {"queries", statistics.queries},
                                       {"us_per_query", statistics.us_per_query},
                                       {"photons_per_query", statistics.photons_per_query},
                                       {"photon_bytes", statistics.photon_bytes},
                                       {"tree_bytes", statistics.tree_bytes},
                                       {"bytes_per_photon", bytes_per_photon(statistics)}};
  return json.dump(2);
}

std::string statistics_as_text(const PhotonMapperStatistics& statistics) {
  std::string text = line("%lld photons sent, %lld stored, %.1f MiB at a time, %.1f bytes a photon\n",
                          static_cast<long long>(statistics.emitted), static_cast<long long>(statistics.stored),
                          static_cast<double>(statistics.photon_bytes + statistics.tree_bytes) / (1 << 20),
                          bytes_per_photon(statistics));
  text += line("%-36s %10s\n", "on all cores", "ms");
  text += line("%-36s %10.1f\n", "emission", statistics.emission_ms);
  text += line("%-36s %10.1f\n", "tree", statistics.tree_ms);
  text += line("%-36s %10.1f\n", "camera rays and direct light", statistics.camera_ms);
  text += line("%-36s %10.1f\n", "queries", statistics.query_ms);
  text += line("%lld queries, %.2f us of one core each, %.1f photons each\n",
               static_cast<long long>(statistics.queries), statistics.us_per_query, statistics.photons_per_query);
  return text;
}

}  // namespace lightwell
