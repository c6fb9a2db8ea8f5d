// Where the parts of a Picture go: files and how their values are shown.
#pragma once

#include <string>
#include <vector>

#include "lightwell/picture.h"

namespace lightwell {

struct Output {
  std::string aov;   // "combined" or a name of --aov
  std::string path;  // .exr or .png
};

// The file of `-o path` and one more for each AOV of the comma-separated list: x.exr and x.indirect.exr. Throws
// InputError if an AOV is unknown, a name ends in neither .exr nor .png, or a file could not be written.
std::vector<Output> plan_outputs(const std::string& path, const std::string& aovs);

// Names that --aov knows, "direct, indirect, ...".
std::string aov_names();

// EXR files get linear values; PNG files what a display shows: radiance exposed and tone-mapped, albedo in sRGB,
// normals as n/2 + 1/2, depth over its maximum. Throws InputError.
void write_outputs(const Picture& picture, const std::vector<Output>& outputs, float exposure);

}  // namespace lightwell
