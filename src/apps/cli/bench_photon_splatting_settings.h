// The published settings of photon splatting, and ours: what their curves are made of.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace lightwell {

constexpr const char* kSplattingTechnique = "photon-splatting";

// What makes a curve of error over time.
enum class SplatCurve : std::uint8_t {
  kMapper,  // pictures of the photon mapper on the CPU, each with more photons
  kFrame,   // single frames, each with more photons
  kFrames   // the mean over more and more frames
};

struct SplatSetting {
  std::string name;
  SplatCurve curve = SplatCurve::kFrame;
  std::string preset;
  std::map<std::string, std::string> options;  // of the technique
  std::vector<int> photons;                    // of a frame or picture, growing
  int memory_photons = 0;                      // of which memory is measured, among those
  double published_bytes = 0.0;                // of photons or cells alone; 0: not published
};

// All, in the order of the tables.
const std::vector<SplatSetting>& splat_settings();

std::vector<std::string> splat_setting_names();

// A scene of the thesis, with its light.
struct SplatScene {
  std::string name;
  bool needs_file = false;
  std::string scale;
  std::string light;  // "": the scene's own
};

const std::vector<SplatScene>& splat_scenes();

}  // namespace lightwell
