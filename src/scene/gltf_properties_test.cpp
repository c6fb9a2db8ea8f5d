// The table of what glTF files may hold: it is that of the documentation, its warnings come, and the importer reads
// what it says.
#include "scene/gltf_properties.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "core/log.h"
#include "scene/test_files.h"

namespace lightwell {
namespace {

using namespace test;

std::vector<std::string> notes_of(const std::string& text) {
  const JsonDocument document("a.gltf", {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  FileNotes notes("a.gltf");
  note_gltf_properties(document, notes);
  const WarningCapture capture;
  notes.log();
  return capture.warnings();
}

std::string read_text(const std::string& name) {
  std::ifstream file(std::string(LIGHTWELL_SOURCE_DIR) + "/" + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> names_in(std::string path) {
  std::vector<std::string> names;
  for (std::size_t dot = 0; dot != std::string::npos; path = path.substr(dot + 1)) {
    dot = path.find('.');
    names.push_back(path.substr(0, dot));
    if (dot == std::string::npos) break;
  }
  return names;
}

// A document in which the property stands once: arrays of one element where the table's place may be one.
std::string document_with(const GltfProperty& property) {
  std::string path = property.path;
  if (path.starts_with("textureInfo.")) path = "materials.emissiveTexture." + path.substr(12);
  if (path.starts_with("any.")) path = path.substr(4);
  if (path.ends_with("_n")) path = path.substr(0, path.size() - 1) + "7";
  const std::string neutral = property.neutral;
  std::string text = neutral.starts_with('!') ? "\"" + neutral.substr(1) + "\"" : "12345";
  const std::vector<std::string> names = names_in(path);
  for (auto name = names.rbegin(); name != names.rend(); ++name) {
    const bool is_list =
        name != names.rbegin() && std::next(name) == names.rend() && *name != "asset" && *name != "extensions";
    text = "{\"" + *name + "\":" + (is_list ? "[" + text + "]" : text) + "}";
  }
  return text;
}

TEST(GltfProperties, WhatIsNotShownIsAWarning) {
  for (const GltfProperty& property : gltf_properties()) {
    const bool is_lost = property.use == GltfUse::kApproximated || property.use == GltfUse::kIgnored;
    const std::vector<std::string> notes = notes_of(document_with(property));
    ASSERT_EQ(notes.size(), is_lost ? 1u : 0u) << property.path << " in " << document_with(property);
    if (is_lost) {
      EXPECT_NE(notes[0].find(property.words), std::string::npos) << notes[0];
    }
  }
}

TEST(GltfProperties, EveryKindIsOneWarningWithItsFirstPlaceAndNumber) {
  const std::vector<std::string> notes = notes_of(R"({"materials":[{},{"normalTexture":{"index":0},"shine":1},
      {"normalTexture":{"index":1},"extensions":{"KHR_materials_sheen":{"x":1},"ACME_glow":{}}},{"shine":2}],
      "extensionsUsed":["ACME_glow","ACME_data","KHR_mesh_quantization"],"name":null})");
  EXPECT_EQ(notes,
            (std::vector<std::string>{
                "a.gltf: materials[1].normalTexture: normal maps are not shown (2 times)",
                "a.gltf: materials[1].shine: shine is no property that is known: ignored (2 times)",
                "a.gltf: materials[2].extensions.ACME_glow: ACME_glow is an extension that is not known: ignored",
                "a.gltf: materials[2].extensions.KHR_materials_sheen: sheen is not shown",
                "a.gltf: name: is null: taken as not there",
                "a.gltf: extensionsUsed: ACME_data is an extension that is not known: ignored"}));
}

TEST(GltfProperties, ValuesThatChangeNothingAreNoWarning) {
  EXPECT_TRUE(notes_of(R"({"materials":[{"doubleSided":true,"alphaMode":"MASK","alphaCutoff":0.4,
      "pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":1.0},"extras":{"a":[1]},
      "extensions":{"KHR_materials_ior":{"ior":1.5}}}],"meshes":[{"primitives":[{"attributes":{"_TEMPERATURE":3}}]}]})")
                  .empty());
  EXPECT_EQ(notes_of(R"({"materials":[{"doubleSided":false},{"alphaMode":"BLEND"}]})").size(), 2u);
}

TEST(GltfProperties, RequiredExtensionsThatOnlyAddLooksAreShownWithout) {
  for (const GltfExtension& known : gltf_extensions())
    EXPECT_TRUE(std::string(known.words).starts_with("where") || can_show_without_loss_of_data(known.name));
  for (const char* looks : {"KHR_materials_new", "ACME_texture_fast", "EXT_lights_area", "KHR_xmp"})
    EXPECT_TRUE(can_show_without_loss_of_data(looks)) << looks;
  for (const char* data : {"EXT_primitive_voxels", "CESIUM_RTC", "ACME_mesh_compression", "MPEG_accessor_timed"})
    EXPECT_FALSE(can_show_without_loss_of_data(data)) << data;
  const TempFolder folder;
  for (const char* name :
       {"KHR_materials_clearcoat", "KHR_materials_variants", "KHR_materials_unlit", "KHR_xmp_json_ld"})
    EXPECT_EQ(folder.error("a.gltf", gltf_of(R"("extensionsRequired":[")" + std::string(name) + "\"]")), "");
}

TEST(GltfProperties, ManyKindsOfNonsenseStayFewWarnings) {
  std::string text = "{\"a\":0";
  for (int i = 0; i < 20000; ++i) text += ",\"x" + std::to_string(i) + "\":0";
  EXPECT_LT(notes_of(text + "}").size(), 100u);
}

// Every member that the importer looks up is in the table, and what the table calls shown is looked up.
TEST(GltfProperties, TheTableIsThatOfTheReaders) {
  std::string source;
  for (const char* name : {"gltf_accessor", "gltf_animations", "gltf_draco", "gltf_file", "gltf_lights",
                           "gltf_materials", "gltf_meshes", "gltf_meshopt", "gltf_nodes"})
    source += read_text("src/scene/" + std::string(name) + ".cpp");
  ASSERT_GT(source.size(), 10000u);
  std::set<std::string> in_table;
  for (const GltfProperty& property : gltf_properties())
    for (const std::string& name : names_in(property.path)) in_table.insert(name);
  for (const GltfExtension& extension : gltf_extensions()) in_table.insert(extension.name);
  const std::regex lookup("\\[\"(\\w+)\"\\]");
  for (std::sregex_iterator match(source.begin(), source.end(), lookup), end; match != end; ++match)
    EXPECT_TRUE(in_table.contains((*match)[1])) << (*match)[1] << " is read and not in the table";
  for (const GltfProperty& property : gltf_properties()) {
    if (property.use != GltfUse::kShown && property.use != GltfUse::kApproximated) continue;
    std::string name = names_in(property.path).back();
    if (name.ends_with("_n")) name.pop_back();
    if (name == "extensionsUsed" || name == "fallback") continue;  // gltf_property_notes.cpp; where there is no data
    EXPECT_NE(source.find('"' + name), std::string::npos) << property.path << " is shown and not read";
  }
}

std::string table_line(const std::string& name, GltfUse use, const std::string& words) {
  return "| `" + name + "` | " + name_of(use) + " | " + words + " |\n";
}

TEST(GltfProperties, TheDocumentationHasTheSameTables) {
  std::string properties;
  for (const GltfProperty& property : gltf_properties())
    properties += table_line(property.path, property.use, property.words);
  std::string extensions;
  for (const GltfExtension& extension : gltf_extensions())
    extensions += table_line(extension.name, extension.use, extension.words);
  const std::string page = read_text("docs/gltf.md");
  EXPECT_NE(page.find(properties), std::string::npos) << "docs/gltf.md should hold\n" << properties;
  EXPECT_NE(page.find(extensions), std::string::npos) << "docs/gltf.md should hold\n" << extensions;
}

}  // namespace
}  // namespace lightwell
