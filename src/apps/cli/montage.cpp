// lightwell montage: pictures side by side, as one PNG. One picture alone: EXR to PNG.
#include "core/montage.h"

#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "apps/cli/commands.h"
#include "apps/cli/text.h"
#include "core/files.h"
#include "lightwell/error.h"
#include "lightwell/image.h"
#include "lightwell/metrics.h"

namespace lightwell {

namespace {

struct MontageArguments {
  std::vector<std::string> pictures;
  std::string labels, output;
  std::string exposure = "1", columns = "0";
};

// Radiance is exposed and tone-mapped; a PNG is ready to be shown as it is.
Image load_for_display(const std::string& path, float exposure) {
  Image image = load_image(path);
  if (!path.ends_with(".png")) return tone_map(image, exposure);
  for (float& value : image.pixels) value = srgb_encode(value);
  return image;
}

void montage(const MontageArguments& arguments) {
  const float exposure = parse_number("--exposure", arguments.exposure, 0, 1e9f);
  const int columns = parse_integer("--columns", arguments.columns, 0, 1000);
  std::vector<std::string> labels;
  if (!arguments.labels.empty()) {
    labels = split(arguments.labels, ',');
    if (labels.size() != arguments.pictures.size())
      throw InputError("--labels", std::to_string(labels.size()) + " labels for " +
                                       std::to_string(arguments.pictures.size()) + " pictures");
  }
  if (!arguments.output.ends_with(".png")) throw InputError(arguments.output, "the name must end in .png");
  check_writable(arguments.output);
  std::vector<MontageTile> tiles;
  for (std::size_t i = 0; i < arguments.pictures.size(); ++i)
    tiles.push_back({load_for_display(arguments.pictures[i], exposure), labels.empty() ? "" : labels[i]});
  save_png(arguments.output, make_montage(tiles, columns));
}

}  // namespace

void add_montage_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("montage", "Put pictures side by side into one PNG");
  const auto arguments = std::make_shared<MontageArguments>();
  command->add_option("PICTURE", arguments->pictures, "Pictures of one size: .exr, .hdr or .png")->required();
  command->add_option("--labels", arguments->labels, "A name above each picture, by comma");
  command->add_option("--exposure", arguments->exposure, "Factor on radiance of .exr and .hdr before display (1)");
  command->add_option("--columns", arguments->columns, "Pictures in a row (0: all)");
  command->add_option("-o,--output", arguments->output, "File to write: .png")->required();
  command->callback([arguments] { montage(*arguments); });
}

}  // namespace lightwell
