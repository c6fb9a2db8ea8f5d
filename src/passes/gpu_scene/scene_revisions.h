// What has changed in the scene since a frame that somebody remembers.
#pragma once

#include <cstdint>

namespace lightwell {

// One number a category: equal numbers mean equal content. A number that stood for one content never stands for
// another, not even where the frame that was to show the first was refused.
struct SceneRevisions {
  std::uint64_t static_geometry = 0;  // which triangles are static, and where; the order of all triangles
  std::uint64_t moving_geometry = 0;  // where vertices are: what is static does not move, and what moves is not static
  std::uint64_t materials = 0;        // with their textures
  std::uint64_t lights = 0;           // point, spot and directional lights
  std::uint64_t environment = 0;

  bool operator==(const SceneRevisions&) const = default;
};

// Whether a triangle is elsewhere or has another number: what was built over the triangles is out of date.
inline bool geometry_changed(const SceneRevisions& a, const SceneRevisions& b) {
  return a.static_geometry != b.static_geometry || a.moving_geometry != b.moving_geometry;
}

// Whether some surface is elsewhere or looks different: what was seen, drawn or traced is out of date. False where only
// the order of the triangles changed, as when something comes to rest.
inline bool surfaces_changed(const SceneRevisions& a, const SceneRevisions& b) {
  return a.moving_geometry != b.moving_geometry || a.materials != b.materials;
}

}  // namespace lightwell
