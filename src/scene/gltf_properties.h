// Every property that a glTF file may hold, and what is made of it. docs/gltf.md shows the same table.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "scene/file_notes.h"
#include "scene/json_document.h"

namespace lightwell {

enum class GltfUse {
  kShown,         // read, and seen in the picture
  kApproximated,  // read, seen as something like it: a warning
  kIgnored,       // a warning
  kNothing,       // nothing of it could be seen: names, hints, what other numbers say again
};

// "shown", "approximated", "ignored", "nothing to show".
const char* name_of(GltfUse use);

struct GltfProperty {
  // Names from the root down; elements of arrays have their array's. "textureInfo." begins those of every property
  // whose name ends in "Texture", "any." those of every object; a name that ends in "_n" stands for all numbers in its
  // place.
  const char* path;
  GltfUse use;
  const char* words = "";    // what is made of it: the warning's text
  const char* neutral = "";  // a value that changes nothing, so that no warning is due; "!WORD": every string but WORD
};

struct GltfExtension {
  const char* name;
  GltfUse use;
  const char* words = "";
};

// In the order of the documentation.
std::span<const GltfProperty> gltf_properties();
std::span<const GltfExtension> gltf_extensions();

// Whether a file that requires the extension can be shown: it is read, or only adds to how things look. Names that are
// not in the table are judged by what they say of themselves (KHR_materials_..., ..._texture_...).
bool can_show_without_loss_of_data(std::string_view extension);

// Notes what the document holds that is approximated, ignored or unknown, and what is null.
void note_gltf_properties(const JsonDocument& document, FileNotes& notes);

}  // namespace lightwell
