#include "renderer/options.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "core/join.h"
#include "core/option_set.h"
#include "gpu/device.h"
#include "lightwell/error.h"

namespace lightwell {
namespace {

// Visits options to see that their values are in range.
class RangeCheck : public OptionVisitor {
 public:
  void visit(const OptionInfo& info, int& value, int minimum, int maximum) override {
    check(info, value, minimum, maximum);
  }
  void visit(const OptionInfo& info, float& value, float minimum, float maximum) override {
    check(info, value, minimum, maximum);
  }
  void visit(const OptionInfo&, bool&) override {}
  void visit(const OptionInfo& info, int& value, std::span<const std::string_view> choices) override {
    check(info, value, 0, static_cast<int>(choices.size()) - 1);
  }

 private:
  template <class T>
  static void check(const OptionInfo& info, T value, T minimum, T maximum) {
    if (value >= minimum && value <= maximum) return;
    throw InputError(
        info.name, std::to_string(value) + " is not in " + std::to_string(minimum) + " to " + std::to_string(maximum));
  }
};

// Options of the world with their values, as text.
class WorldOptionList : public OptionVisitor {
 public:
  explicit WorldOptionList(std::string text) : text_(std::move(text)) {}
  const std::string& text() const { return text_; }

  void visit(const OptionInfo& info, int& value, int, int) override { add(info, std::to_string(value)); }
  void visit(const OptionInfo& info, float& value, float, float) override {
    add(info, std::to_string(std::bit_cast<std::uint32_t>(value)));
  }
  void visit(const OptionInfo& info, bool& value) override { add(info, std::to_string(value)); }
  void visit(const OptionInfo& info, int& value, std::span<const std::string_view>) override {
    add(info, std::to_string(value));
  }

 private:
  void add(const OptionInfo& info, const std::string& value) {
    if (info.scope == OptionScope::kWorld) text_.append(" ").append(info.name).append("=").append(value);
  }

  std::string text_;
};

// The one that is named, or the technique's first.
std::string_view preset_of(const RendererOptions& options, const TechniqueInfo& info) {
  return options.preset.empty() ? info.presets[0] : std::string_view(options.preset);
}

const TechniqueInfo& find_technique(const std::string& name) {
  std::vector<std::string_view> names{"none"};
  for (const TechniqueInfo* info : techniques()) {
    if (info->name == name) return *info;
    names.push_back(info->name);
  }
  throw InputError("technique", "'" + name + "' is unknown; there are: " + join(names));
}

}  // namespace

void RendererOptions::describe(OptionVisitor& visitor) {
  visitor.visit({"samples", "Jittered frames at the end that are averaged (1 pixel box): anti-aliasing.", "",
                 "time in proportion"},
                samples, 1, 65536);
  visitor.visit({"frames", "Exactly so many frames, the last of them averaged; 0: until the technique is steady.", "",
                 "time in proportion"},
                frames, 0, 1000000);
  visitor.visit(
      {"shadow-map-size",
       "Side of one view of a shadow map, four times that for suns and lights far outside the scene; less where the "
       "atlas, of 256 MiB at most, would not hold all.",
       "texels", "memory and time with its square"},
      shadow_map_size, 32, 8192);
  static constexpr std::array<std::string_view, 2> kShadows{"maps", "rays"};
  visitor.visit({"shadows", "How point, spot and directional lights are shadowed; rays are exact.", "",
                 "rays: a ray a pixel and light"},
                shadows, kShadows);
  visitor.visit(
      {"light-samples",
       "Rays a pixel and frame to emitters, and as many to the environment; 0: only the technique lights with "
       "them.",
       "", "time in proportion"},
      light_samples, 0, 64);
  static constexpr std::array<std::string_view, 3> kTracing{"auto", "bvh", "ray-query"};
  visitor.visit({"tracing",
                 "Who answers rays: Lightwell's own hierarchy, the device's ray queries, or what a short measurement "
                 "finds the faster.",
                 "", ""},
                tracing, kTracing);
}

std::optional<Tracing> fixed_tracing(const Device& device, int option) {
  if (option == 0) return {};
  if (option == 1) return Tracing::kBvh;
  if (!device.has_ray_query()) throw InputError("tracing", device.summary().name + " has no ray queries");
  return Tracing::kRayQuery;
}

std::string world_key(const RendererOptions& options, Technique& technique, LightKinds covered) {
  const std::string preset(preset_of(options, find_technique(options.technique)));
  WorldOptionList list(options.technique + " " + preset + " " + std::to_string(static_cast<unsigned>(covered)));
  technique.describe(list);
  return list.text();
}

std::unique_ptr<Technique> create_technique(const RendererOptions& options) {
  if (options.technique == "none") {
    if (!options.preset.empty() || !options.technique_options.empty()) {
      throw InputError("technique", "'none' has no presets and no options");
    }
    return nullptr;
  }
  const TechniqueInfo& info = find_technique(options.technique);
  const std::string_view preset = preset_of(options, info);
  if (std::find(info.presets.begin(), info.presets.end(), preset) == info.presets.end()) {
    throw InputError(
        "preset", "'" + options.preset + "' is none of " + options.technique + "'s; there are: " + join(info.presets));
  }
  std::unique_ptr<Technique> technique = info.create(preset);
  for (const std::string& assignment : options.technique_options) {
    set_option([&](OptionVisitor& visitor) { technique->describe(visitor); }, assignment);
  }
  return technique;
}

void check_options(const RendererOptions& options, std::uint32_t largest_side) {
  for (const int side : {options.width, options.height}) {
    if (side >= 1 && static_cast<std::uint32_t>(side) <= largest_side) continue;
    throw InputError("size", std::to_string(options.width) + "x" + std::to_string(options.height) + " is not in 1 to " +
                                 std::to_string(largest_side) + " pixels a side");
  }
  RendererOptions copy = options;
  RangeCheck check;
  copy.describe(check);
}

}  // namespace lightwell
