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

// `-o` names one file, or one a frame where it holds a number format such as "out.%04d.exr".
class FrameNames {
 public:
  // Throws InputError if there is a '%' that is no such format, or more than one.
  explicit FrameNames(const std::string& path);
  bool is_pattern() const { return digits_ > 0; }
  std::string name(int frame) const;

 private:
  std::string before_, after_;
  int digits_ = 0;  // 0: no pattern
};

// Whether a picture has a part of this name.
bool is_aov(const std::string& name);

// Names that --aov knows, "direct, indirect, ...".
std::string aov_names();

// EXR files get linear values; PNG files what a display shows: radiance exposed and tone-mapped, albedo in sRGB,
// normals as n/2 + 1/2, depth over its maximum. Throws InputError.
void write_outputs(const Picture& picture, const std::vector<Output>& outputs, float exposure);

}  // namespace lightwell
