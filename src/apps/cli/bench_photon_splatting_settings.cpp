#include "apps/cli/bench_photon_splatting_settings.h"

namespace lightwell {

namespace {

constexpr double kMegabyte = 1024.0 * 1024.0;

constexpr int kMapped = 50000, kSmall = 25000, kLarge = 2500;  // photons of the published table of memory
constexpr int kBest = 16384;                                   // of each frame

// Quality is published from low to high: the most photons are four times those of the table of memory.
std::vector<int> steps_to(int photons) {
  return {photons / 16, photons / 4, photons, 4 * photons};
}

// The width of the maps is not published. Here it is such that all of the Cornell box is below some splats when there
// are as many photons as in the table of memory. Large maps are three times as wide, as in the thesis' Fig. 17, with
// the more texels that its 5.3.1 asks for. Maps reach as far before and behind the photon as they are wide: on slanted
// surfaces those that reach less far are cut off. Bundles have no largest width.
SplatSetting maps(const char* name, const char* width, const char* map_size, int photons) {
  SplatSetting setting;
  setting.name = name;
  setting.preset = "paper";
  setting.options = {{"width", width}, {"map-size", map_size}, {"step-back", width}, {"most-width", "1"}};
  setting.photons = steps_to(photons);
  setting.memory_photons = photons;
  return setting;
}

// The thesis' rule of thumb is as many photons as without; its pass merges once.
SplatSetting stratified(int cells) {
  SplatSetting setting = maps("", "0.06", "4", kSmall);
  setting.name = "stratified-" + std::to_string(cells);
  setting.options["stratify"] = std::to_string(cells);
  if (cells == 256) setting.published_bytes = 576.0 * kMegabyte;
  return setting;
}

std::vector<SplatSetting> make_settings() {
  std::vector<SplatSetting> settings;
  settings.push_back({"photon-mapping", SplatCurve::kMapper, "", {}, steps_to(kMapped), kMapped, 1.71 * kMegabyte});
  settings.push_back(maps("small-maps", "0.06", "4", kSmall));
  settings.back().published_bytes = 0.85 * kMegabyte;
  settings.push_back(maps("large-maps", "0.18", "16", kLarge));
  settings.back().published_bytes = 0.08 * kMegabyte;
  for (const int cells : {16, 32, 64, 128, 256}) settings.push_back(stratified(cells));
  settings.push_back({"best", SplatCurve::kFrames, "best", {}, {kBest}, kBest});
  // Fewer photons a frame, and the mean over frames alone to smooth them.
  const auto quick = [&](const char* name, int photons, const char* kernel_photons) {
    settings.push_back({name,
                        SplatCurve::kFrames,
                        "best",
                        {{"sampling", "4"}, {"kernel-photons", kernel_photons}, {"filter", "off"}},
                        {photons},
                        photons});
  };
  quick("best-8192", 8192, "96");
  quick("best-2048", 2048, "32");
  return settings;
}

}  // namespace

const std::vector<SplatSetting>& splat_settings() {
  static const std::vector<SplatSetting> settings = make_settings();
  return settings;
}

std::vector<std::string> splat_setting_names() {
  std::vector<std::string> names;
  for (const SplatSetting& setting : splat_settings()) names.push_back(setting.name);
  return names;
}

// The shared file of the conference room has no opening for the evening sun of the thesis: a spot light by the wall,
// low and warm, stands for what would come in through a window.
const std::vector<SplatScene>& splat_scenes() {
  static const std::vector<SplatScene> scenes = {
      {"cornell-spot", false, "1", ""},
      {"conference", true, "0.003", "spot pos=-1.9,1.5,1.0 dir=1,-0.25,-0.4 intensity=12,8,5 inner=35 outer=45"}};
  return scenes;
}

}  // namespace lightwell
