#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lightwell/error.h"
#include "lightwell/scene.h"

namespace lightwell {

namespace {

bool is_near(const glm::vec3& v) {
  // NaN is not near.
  return std::abs(v.x) <= kMaxCoordinate && std::abs(v.y) <= kMaxCoordinate && std::abs(v.z) <= kMaxCoordinate;
}

bool is_near(const glm::mat4& m) {
  return is_near(glm::vec3(m[0])) && is_near(glm::vec3(m[1])) && is_near(glm::vec3(m[2])) && is_near(glm::vec3(m[3]));
}

bool is_finite(const glm::mat4& m) {
  const float* entries = &m[0][0];
  return std::all_of(entries, entries + 16, [](float entry) { return std::isfinite(entry); });
}

// How far joints and weights may carry vertices shows in the bounds.
bool is_near(const MeshInstance& instance) {
  return is_near(instance.to_world) && std::all_of(instance.joints.begin(), instance.joints.end(), is_finite) &&
         std::all_of(instance.morph_weights.begin(), instance.morph_weights.end(),
                     [](float weight) { return std::isfinite(weight); });
}

}  // namespace

void validate(const SceneSnapshot& snapshot, const std::string& subject) {
  const auto require = [&](bool condition, const char* what, std::size_t index) {
    if (!condition)
      throw InputError(subject, std::string(what) + " " + std::to_string(index) +
                                    " reaches farther than 1e9 metres or is not finite");
  };
  for (std::size_t i = 0; i < snapshot.instances.size(); ++i) require(is_near(snapshot.instances[i]), "instance", i);
  for (std::size_t i = 0; i < snapshot.lights.size(); ++i) require(is_near(snapshot.lights[i].position), "light", i);
  for (std::size_t i = 0; i < snapshot.cameras.size(); ++i) require(is_near(snapshot.cameras[i].position), "camera", i);
  if (!is_near(snapshot.bounds.minimum) || !is_near(snapshot.bounds.maximum))
    throw InputError(subject, "a vertex reaches farther than 1e9 metres or is not finite");
}

}  // namespace lightwell
