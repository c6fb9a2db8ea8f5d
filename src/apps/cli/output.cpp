#include "apps/cli/output.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "apps/cli/text.h"
#include "core/files.h"
#include "lightwell/error.h"
#include "lightwell/metrics.h"

namespace lightwell {

namespace fs = std::filesystem;

namespace {

enum class Display { kRadiance, kColor, kNormal, kDepth };

struct Aov {
  const char* name;
  Image Picture::*image;
  Display display;
};

constexpr std::array<Aov, 8> kAovs = {{
    {"combined", &Picture::combined, Display::kRadiance},
    {"direct", &Picture::direct, Display::kRadiance},
    {"indirect", &Picture::indirect, Display::kRadiance},
    {"emission", &Picture::emission, Display::kRadiance},
    {"albedo", &Picture::albedo, Display::kColor},
    {"normal", &Picture::normal, Display::kNormal},
    {"depth", &Picture::depth, Display::kDepth},
    {"variance", &Picture::variance, Display::kRadiance},
}};

const Aov* find_aov(const std::string& name) {
  const auto found = std::find_if(kAovs.begin(), kAovs.end(), [&](const Aov& aov) { return aov.name == name; });
  return found == kAovs.end() ? nullptr : found;
}

template <typename Function>
Image map_values(const Image& image, Function function) {
  Image mapped = image;
  std::transform(image.pixels.begin(), image.pixels.end(), mapped.pixels.begin(), function);
  return mapped;
}

Image shown(const Image& image, Display display, float exposure) {
  switch (display) {
    case Display::kRadiance:
      return tone_map(image, exposure);
    case Display::kColor:
      return map_values(image, [](float x) { return srgb_encode(std::clamp(x, 0.0f, 1.0f)); });
    case Display::kNormal:
      return map_values(image, [](float x) { return 0.5f * x + 0.5f; });
    case Display::kDepth:
      break;
  }
  const float largest = *std::max_element(image.pixels.begin(), image.pixels.end());
  return map_values(image, [=](float x) { return largest > 0.0f ? x / largest : 0.0f; });
}

std::string path_of_aov(const std::string& path, const std::string& aov) {
  fs::path result(path);
  return result.replace_extension(aov + fs::path(path).extension().string()).string();
}

void check_extension(const std::string& path) {
  const std::string extension = fs::path(path).extension().string();
  if (extension != ".exr" && extension != ".png") throw InputError(path, "the name must end in .exr or .png");
}

}  // namespace

std::string aov_names() {
  std::vector<std::string> names;
  for (const Aov& aov : kAovs)
    if (aov.name != std::string("combined")) names.emplace_back(aov.name);
  return join(names);
}

bool is_aov(const std::string& name) {
  return find_aov(name) != nullptr;
}

std::vector<Output> plan_outputs(const std::string& path, const std::string& aovs) {
  std::vector<Output> outputs = {{"combined", path}};
  if (!aovs.empty())
    for (const std::string& name : split(aovs, ',')) {
      if (!find_aov(name)) throw InputError("--aov", "'" + name + "' is not one of " + aov_names());
      outputs.push_back({name, path_of_aov(path, name)});
    }
  for (const Output& output : outputs) {
    check_extension(output.path);
    check_writable(output.path);
  }
  return outputs;
}

void write_outputs(const Picture& picture, const std::vector<Output>& outputs, float exposure) {
  for (const Output& output : outputs)
    if ((picture.*(find_aov(output.aov)->image)).pixels.empty())
      throw InputError("--aov", output.aov + " is not known from a single sample");
  for (const Output& output : outputs) {
    const Aov* aov = find_aov(output.aov);
    const Image& image = picture.*(aov->image);
    if (fs::path(output.path).extension() == ".exr")
      save_exr(output.path, image);
    else
      save_png(output.path, shown(image, aov->display, exposure));
  }
}

FrameNames::FrameNames(const std::string& path) : before_(path) {
  const std::size_t percent = path.find('%');
  if (percent == std::string::npos) return;
  std::size_t end = percent + 1;
  if (end < path.size() && path[end] == '0') ++end;
  const std::size_t digits = end;
  while (end < path.size() && path[end] >= '0' && path[end] <= '9') ++end;
  const bool format = end < path.size() && path[end] == 'd' && end - digits <= 1;
  if (!format || path.find('%', end) != std::string::npos)
    throw InputError("--output", "'" + path + "': a frame number is written as %04d, once");
  digits_ = end > digits ? path[digits] - '0' : 1;
  if (digits_ == 0) digits_ = 1;
  before_ = path.substr(0, percent);
  after_ = path.substr(end + 1);
}

std::string FrameNames::name(int frame) const {
  if (!is_pattern()) return before_;
  std::string number = std::to_string(frame);
  number.insert(0, static_cast<std::size_t>(std::max(0, digits_ - static_cast<int>(number.size()))), '0');
  return before_ + number + after_;
}

}  // namespace lightwell
