#include "apps/cli/bench_photon_splatting_print.h"

#include <cstdio>
#include <string>

#include <nlohmann/json.hpp>

namespace lightwell {

namespace {

using Json = nlohmann::ordered_json;

void print_curves(const Json& scene) {
  const Json& truth = scene["truth"];
  std::printf("%s: indirect light, %ld pixels away from edges\n", scene["scene"].get<std::string>().c_str(),
              scene["pixels"].get<long>());
  std::printf("truth: %d paths a pixel in %.1f s; its own RMSE %.3f and relMSE %.2g are subtracted\n",
              truth["samples"].get<int>(), truth["seconds"].get<double>(), truth["noise_rmse8"].get<double>(),
              truth["noise_relMSE"].get<double>());
  std::printf("%-16s %8s %6s %5s %11s %8s %10s %7s %8s\n", "setting", "photons", "frames", "k", "ms", "RMSE", "relMSE",
              "energy", "factor");
  for (const Json& curve : scene["curves"])
    for (const Json& point : curve["points"])
      std::printf("%-16s %8d %6d %5d %11.2f %8.3f %10.3g %7.3f %8.3g\n", curve["setting"].get<std::string>().c_str(),
                  point["photons"].get<int>(), point["frames"].get<int>(), point.value("k", 0),
                  point["time_ms"].get<double>(), point["rmse8"].get<double>(), point["relMSE"].get<double>(),
                  point["energy"].get<double>(), point["factor"].get<double>());
}

void print_equal_errors(const Json& rows) {
  for (const Json& row : rows) {
    const Json& mapper = row["mapper"];
    std::printf("equal RMSE %.3f: photon mapping %.1f ms (%d photons, k %d, %.1f us a query); ",
                mapper["rmse8"].get<double>(), mapper["time_ms"].get<double>(), mapper["photons"].get<int>(),
                mapper["k"].get<int>(), mapper["us_per_query"].get<double>());
    if (row["best_ms"].is_null())
      std::printf("best does not reach it\n");
    else
      std::printf("%s %s%.1f ms, ratio %.3f\n", row["setting"].get<std::string>().c_str(),
                  row["at_most"].get<bool>() ? "at most " : "", row["best_ms"].get<double>(),
                  row["ratio"].get<double>());
  }
}

void print_memory(const Json& rows) {
  const auto megabytes = [](const Json& bytes) { return bytes.get<double>() / (1 << 20); };
  std::printf("%-16s %8s %10s %10s %8s %10s %10s %12s\n", "memory, MiB", "photons", "splats", "with paths", "B each",
              "maps", "lists", "published");
  for (const Json& row : rows) {
    std::printf("%-16s %8ld %10.3f %10.3f %8.1f %10.3f %10.3f", row["setting"].get<std::string>().c_str(),
                row["photons"].get<long>(), megabytes(row["splat_bytes"]), megabytes(row["photon_bytes"]),
                row["bytes_a_photon"].get<double>(), megabytes(row["map_bytes"]), megabytes(row["tile_bytes"]));
    if (row.contains("published")) std::printf(" %12.2f", megabytes(row["published"]["bytes"]));
    std::printf("\n");
  }
}

}  // namespace

void print_splat_scene(const Json& scene) {
  print_curves(scene);
  print_equal_errors(scene["equal_error"]);
  print_memory(scene["memory"]);
  std::printf("\n");
}

}  // namespace lightwell
