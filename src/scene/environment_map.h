// Image files as light from outside.
#pragma once

#include <string>

#include "lightwell/image.h"

namespace lightwell {

// Reads a map of the sphere of directions (Environment::map): no number in it is negative, infinite or more than
// kMaxLight, and it is 8192 pixels wide at most. Warns of all that it changes for that, and of formats without bright
// light. Throws InputError as load_image() does.
Image load_environment_map(const std::string& path);

}  // namespace lightwell
