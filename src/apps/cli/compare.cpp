// lightwell compare: how far a picture is from the truth.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/cli/commands.h"
#include "apps/cli/text.h"
#include "core/files.h"
#include "lightwell/error.h"
#include "lightwell/metrics.h"

namespace lightwell {

namespace {

using Json = nlohmann::ordered_json;

struct CompareArguments {
  std::string test, reference;
  std::string mask, scene, diff, variance;
  std::string exposure, epsilon = "0.01", block = "1";
  bool json = false;
};

// What scene.json, beside the shared reference pictures, says about them.
struct SceneFile {
  float exposure = 1.0f;
  std::optional<double> reference_noise;  // relMSE of the reference itself
};

SceneFile read_scene_file(const std::string& path, const std::string& reference) {
  const std::vector<std::uint8_t> bytes = read_file(path, 1 << 24);
  const nlohmann::json file = nlohmann::json::parse(bytes, nullptr, false);
  if (!file.is_object()) throw InputError(path, "not a JSON object");
  SceneFile result;
  const auto number = [&](const nlohmann::json& object, const char* key) -> std::optional<double> {
    const auto found = object.find(key);
    if (found == object.end()) return std::nullopt;
    if (!found->is_number()) throw InputError(path, std::string(key) + " is not a number");
    return found->get<double>();
  };
  result.exposure = static_cast<float>(number(file, "exposure").value_or(1.0));
  if (!std::isfinite(result.exposure) || result.exposure < 0) throw InputError(path, "exposure is not positive");
  const std::string name = std::filesystem::path(reference).filename().string();
  const auto references = file.find("references");
  if (references == file.end() || !references->is_array()) return result;
  for (const nlohmann::json& entry : *references) {
    const auto combined = entry.is_object() ? entry.find("combined") : entry.end();
    if (!entry.is_object() || combined == entry.end() || *combined != name) continue;
    result.reference_noise = number(entry, "noise_relMSE");
    break;
  }
  return result;
}

// A mask counts by its codes, not by light: gray above one half is in.
Image load_mask(const std::string& path) {
  if (std::filesystem::path(path).extension() != ".png") return load_image(path);
  const std::vector<std::uint8_t> bytes = read_file(path);
  const Image8 codes = decode_image8(path, bytes.data(), bytes.size());
  Image mask(codes.width, codes.height, 1);
  for (std::size_t i = 0; i < mask.pixels.size(); ++i) mask.pixels[i] = static_cast<float>(codes.rgba[i * 4]) / 255.0f;
  return mask;
}

Json as_json(const Metrics& metrics, float exposure, const SceneFile& scene, bool averaged) {
  Json json = {{"pixels", metrics.pixels},
               {"bad_pixels", metrics.bad_pixels},
               {"relMSE", metrics.rel_mse},
               {"rmse8", metrics.rmse8},
               {"rmse8_tm", metrics.rmse8_tone_mapped},
               {"ssim", metrics.ssim},
               {"flip", metrics.flip},
               {"energy", metrics.energy},
               {"energy_rgb", metrics.energy_rgb},
               {"max_abs", metrics.max_abs},
               {"p99_abs", metrics.p99_abs},
               {"mean_test", metrics.mean_test},
               {"mean_ref", metrics.mean_reference},
               {"exposure", exposure}};
  // Block averages have less noise than was measured.
  if (scene.reference_noise && !averaged) json["relMSE_floor"] = *scene.reference_noise;
  return json;
}

// Infinitely many deviations, where the reference has no noise, are null in JSON.
void add_noise(const NoiseMetrics& noise, Json& json) {
  json["relMSE_noise"] = noise.rel_mse;
  json["noise_part"] = noise.part;
  json["relMSE_rest"] = noise.rest;
  json["rest_sigmas"] = noise.rest_sigmas;
  json["energy_sigma"] = noise.energy_sigma;
  json["energy_sigmas"] = noise.energy_sigmas;
  json["significant"] = noise.significant;
}

void print_verdict(const NoiseMetrics& noise) {
  std::printf(
      "The reference's noise explains %.3g %% of the squared difference; the rest is %s: relMSE %.3g (%.1f sigma), "
      "energy %+.1f "
      "sigma.\n",
      100 * noise.part, noise.significant ? "significant" : "not significant", noise.rest, noise.rest_sigmas,
      noise.energy_sigmas);
}

void print_table(const Json& json) {
  for (const auto& [name, value] : json.items()) {
    std::printf("%-13s", name.c_str());
    if (value.is_boolean()) std::printf(" %s", value.get<bool>() ? "yes" : "no");
    for (const Json& number : value.is_array() ? value : Json::array({value}))
      if (number.is_number()) std::printf(" %.6g", number.get<double>());
    std::printf("\n");
  }
}

void compare(const CompareArguments& arguments) {
  SceneFile scene;
  if (!arguments.scene.empty()) scene = read_scene_file(arguments.scene, arguments.reference);
  MetricOptions options;
  options.exposure =
      arguments.exposure.empty() ? scene.exposure : parse_number("--exposure", arguments.exposure, 0, 1e9f);
  options.epsilon = parse_number("--eps", arguments.epsilon, 1e-20f, 1e9f);
  options.block = parse_integer("--block", arguments.block, 1, kMaxImageSide);
  if (!arguments.diff.empty()) {
    if (!arguments.diff.ends_with(".png")) throw InputError(arguments.diff, "the name must end in .png");
    check_writable(arguments.diff);
  }
  const Image test = load_image(arguments.test);
  const Image reference = load_image(arguments.reference);
  Image mask;
  if (!arguments.mask.empty()) {
    mask = load_mask(arguments.mask);
    options.mask = &mask;
  }
  Image variance;
  if (!arguments.variance.empty()) {
    variance = load_image(arguments.variance);
    options.variance = &variance;
  }
  const Metrics metrics = compute_metrics(test, reference, options);
  if (!arguments.diff.empty()) save_png(arguments.diff, difference_heat_map(test, reference, options.exposure));
  Json json = as_json(metrics, options.exposure, scene, options.block > 1);
  if (options.variance) add_noise(metrics.noise, json);
  if (arguments.json) {
    std::printf("%s\n", json.dump().c_str());
    return;
  }
  print_table(json);
  if (options.variance) print_verdict(metrics.noise);
}

}  // namespace

void add_compare_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("compare", "Compare a picture with its reference");
  const auto arguments = std::make_shared<CompareArguments>();
  command->add_option("TEST", arguments->test, "Picture to be judged: .exr, .hdr or .png")->required();
  command->add_option("REFERENCE", arguments->reference, "The truth, of the same size")->required();
  command->add_option("--mask", arguments->mask, "Image: only pixels above one half count");
  command->add_option("--exposure", arguments->exposure, "Factor on radiance before display (of --scene, or 1)");
  command->add_option("--scene", arguments->scene, "scene.json: exposure and the reference's own noise");
  command->add_option("--variance", arguments->variance,
                      "The reference's x.variance.exr (--aov variance): what of the difference is its noise");
  command->add_option("--block", arguments->block, "Average N x N pixels first, where the reference is noisy (1)");
  command->add_option("--eps", arguments->epsilon, "relMSE divides by r^2 + this; smaller for dark pictures (0.01)");
  command->add_option("--diff", arguments->diff, "Write a heat map of the difference to this .png");
  command->add_flag("--json", arguments->json, "Print JSON");
  command->callback([arguments] { compare(*arguments); });
}

}  // namespace lightwell
