#include "scene/light_spec.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include "core/log.h"
#include "lightwell/error.h"
#include "scene/environment_map.h"
#include "scene/text_scanner.h"

namespace lightwell {

namespace {

std::string in_quotes(std::string_view text) {
  return std::string(1, '\'').append(text).append("'");
}

// One number (repeated) or three, separated by commas.
std::optional<glm::dvec3> parse_numbers(std::string_view text, bool one_is_enough) {
  glm::dvec3 values(0.0);
  for (int i = 0; i < 3; ++i) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const std::string_view word = trimmed(text.substr(0, comma));
    if (!parse_float(word)) return std::nullopt;
    const std::optional<double> number = parse_double(word);
    values[i] = *number;
    const bool last = comma == text.size();
    if (last && i == 0 && one_is_enough) return glm::dvec3(*number);
    if (last != (i == 2)) return std::nullopt;
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return values;
}

bool is_too_bright(const glm::vec3& light) {
  return std::max({light.r, light.g, light.b}) > kMaxLight;
}

// The words "key=value" of a description, after its first word.
class LightSpec {
 public:
  LightSpec(const char* option, const std::string& spec) : option_(option), spec_(spec) {
    std::string_view rest = spec_;
    kind_ = take_word(rest);
    for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
      const std::size_t equals = word.find('=');
      if (equals == std::string_view::npos) fail("expected key=value, got " + in_quotes(word));
      if (!values_.emplace(word.substr(0, equals), word.substr(equals + 1)).second)
        fail(in_quotes(word.substr(0, equals)) + " is given twice");
    }
  }

  std::string_view kind() const { return kind_; }

  void allow(std::initializer_list<std::string_view> keys) const {
    for (const auto& [key, value] : values_)
      if (std::find(keys.begin(), keys.end(), key) == keys.end())
        fail("a " + std::string(kind_) + " light has no " + in_quotes(key));
  }

  glm::dvec3 vector(std::string_view key) const {
    const std::optional<glm::dvec3> v = parse_numbers(value(key), false);
    if (!v) fail(in_quotes(key) + " needs three numbers: " + std::string(key) + "=x,y,z");
    return *v;
  }

  glm::dvec3 position(std::string_view key) const {
    const glm::dvec3 v = vector(key);
    for (int i = 0; i < 3; ++i)
      if (std::abs(v[i]) > double{kMaxCoordinate}) fail(in_quotes(key) + " is farther away than 1e9 metres");
    return v;
  }

  glm::vec3 color(std::string_view key) const {
    const std::optional<glm::vec3> c = parse_numbers(value(key), true);
    if (!c || c->r < 0.0f || c->g < 0.0f || c->b < 0.0f)
      fail(in_quotes(key) + " needs one or three numbers, none negative: " + std::string(key) + "=r,g,b");
    if (is_too_bright(*c)) fail(in_quotes(key) + " is more than 1e18");
    return *c;
  }

  glm::vec3 direction(std::string_view key) const {
    const glm::dvec3 v = vector(key);
    const double length = glm::length(v);
    if (!(length > 0.0)) fail(in_quotes(key) + " has no length");
    return glm::vec3(v / length);
  }

  float angle(std::string_view key, float fallback) const {
    const auto found = values_.find(key);
    if (found == values_.end()) return fallback;
    const std::optional<float> degrees = parse_float(found->second);
    if (!degrees || *degrees < 0.0f || *degrees > 90.0f) fail(in_quotes(key) + " must be 0 to 90 degrees");
    return glm::radians(*degrees);
  }

  [[noreturn]] void fail(const std::string& cause) const { throw InputError(option_, in_quotes(spec_) + ": " + cause); }

 private:
  std::string_view value(std::string_view key) const {
    const auto found = values_.find(key);
    if (found == values_.end()) fail(in_quotes(key) + " is missing");
    return found->second;
  }

  const char* option_;
  const std::string& spec_;
  std::string_view kind_;
  std::map<std::string_view, std::string_view> values_;
};

// The rotation that takes a node's -Z to `direction`. Directions behind start from half a turn about Y, which takes -Z
// to +Z, so that the shortest arc is never near half a turn, where it is ill-defined.
glm::quat pointing_along(const glm::vec3& direction) {
  const bool behind = direction.z > 0.0f;
  const glm::vec3 from(0.0f, 0.0f, behind ? 1.0f : -1.0f);
  const glm::vec3 axis = glm::cross(from, direction);
  const glm::quat arc = glm::normalize(glm::quat(1.0f + glm::dot(from, direction), axis.x, axis.y, axis.z));
  return behind ? arc * glm::quat(0.0f, 0.0f, 1.0f, 0.0f) : arc;
}

void append(Scene& scene, Light light, const glm::dvec3& position, const glm::vec3& direction) {
  Node node;
  node.name = light.name;
  node.translation = position;
  node.rotation = pointing_along(direction);
  node.light = static_cast<int>(scene.lights.size());
  scene.lights.push_back(std::move(light));
  scene.nodes.push_back(std::move(node));
}

void append_sun(Scene& scene, const LightSpec& spec) {
  spec.allow({"dir", "irradiance"});
  Light light;
  light.name = "sun";
  light.type = LightType::kDirectional;
  light.intensity = spec.color("irradiance");
  const glm::vec3 direction = spec.direction("dir");
  if (direction.y > 0.0f)
    log_warning("the sun shines upwards: its direction is the way the light goes, not the way to the sun");
  append(scene, std::move(light), glm::dvec3(0.0), direction);
}

void append_point(Scene& scene, const LightSpec& spec) {
  spec.allow({"pos", "intensity"});
  Light light;
  light.name = "point";
  light.intensity = spec.color("intensity");
  append(scene, std::move(light), spec.position("pos"), {0.0f, 0.0f, -1.0f});
}

void append_spot(Scene& scene, const LightSpec& spec) {
  spec.allow({"pos", "dir", "intensity", "inner", "outer"});
  Light light;
  light.name = "spot";
  light.type = LightType::kSpot;
  light.intensity = spec.color("intensity");
  light.inner_angle = spec.angle("inner", light.inner_angle);
  light.outer_angle = spec.angle("outer", light.outer_angle);
  if (light.inner_angle >= light.outer_angle) spec.fail("'inner' must be smaller than 'outer'");
  append(scene, std::move(light), spec.position("pos"), spec.direction("dir"));
}

}  // namespace

void add_light(Scene& scene, const std::string& spec) {
  const LightSpec parsed("--light", spec);
  if (parsed.kind() == "point")
    append_point(scene, parsed);
  else if (parsed.kind() == "spot")
    append_spot(scene, parsed);
  else if (parsed.kind() == "sun")
    append_sun(scene, parsed);
  else
    parsed.fail("expected point, spot or sun first");
}

void add_sun(Scene& scene, const std::string& spec) {
  std::string_view rest = spec;
  const std::string direction(take_word(rest));
  const std::string irradiance(take_word(rest));
  if (irradiance.empty() || !trimmed(rest).empty())
    throw InputError("--sun", in_quotes(spec) + ": expected \"x,y,z irradiance\"");
  const std::string in_full = "sun dir=" + direction + " irradiance=" + irradiance;
  append_sun(scene, LightSpec("--sun", in_full));
}

void remove_lights(Scene& scene) {
  scene.lights.clear();
  for (Node& node : scene.nodes) node.light = -1;
}

Environment parse_environment(const std::string& spec) {
  Environment environment;
  if (const std::optional<glm::vec3> radiance = parse_numbers(spec, true)) {
    if (radiance->r < 0.0f || radiance->g < 0.0f || radiance->b < 0.0f)
      throw InputError("--env", in_quotes(spec) + ": radiance is negative");
    if (is_too_bright(*radiance)) throw InputError("--env", in_quotes(spec) + " is more than 1e18");
    environment.radiance = *radiance;
    return environment;
  }
  environment.radiance = glm::vec3(1.0f);
  std::error_code ignored;
  if (!std::filesystem::exists(spec, ignored))
    throw InputError("--env", in_quotes(spec) + " is neither r,g,b nor an image file");
  environment.map = load_environment_map(spec);
  return environment;
}

}  // namespace lightwell
