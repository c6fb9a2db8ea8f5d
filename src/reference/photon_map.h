// Photons on surfaces, and the irradiance that they mean there (Jensen 1996).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/ext/vector_float3.hpp>

namespace lightwell {

// Light that arrived at a surface.
struct Photon {
  glm::vec3 position{0.0f};
  glm::vec3 flux{0.0f};    // W
  glm::vec3 normal{0.0f};  // unit, geometric, on the side where it arrived
};

// Neighbours are measured in the norm whose unit ball is a flat cylinder about the normal: the larger one of the
// distance along the tangent plane and the height over it divided by kDiscThickness. So another surface behind or
// before a thin one, or a step, is far. A photon counts where its surface looks the same way: its normal's cosine to
// the one at the point, which is also its weight, is kLeastNormalCosine at least. With that weight curved surfaces
// come out right: they hold 1 / cosine times the photons that a flat disc would.
class PhotonMap {
 public:
  static constexpr float kDiscThickness = 0.25f;
  static constexpr float kLeastNormalCosine = 0.6f;

  struct Neighbor {
    float distance_squared;
    std::uint32_t photon;
  };
  // Kept by who asks often, so that memory is not asked for each time.
  using Scratch = std::vector<Neighbor>;

  struct Estimate {
    glm::vec3 irradiance{0.0f};  // W/m^2
    float radius = 0.0f;         // of the disc, m
    int photons = 0;             // that counted
  };

  explicit PhotonMap(std::vector<Photon> photons);
  ~PhotonMap();
  PhotonMap(PhotonMap&&) noexcept;
  PhotonMap& operator=(PhotonMap&&) noexcept;

  // From the photons nearer than the k-th, over the disc up to it: the k-th itself is on the rim, and counting it would
  // make everything k / (k - 1) times too bright. Where fewer than k are within `max_radius`, from all of those, over
  // that disc. k >= 2.
  Estimate nearest(const glm::vec3& point, const glm::vec3& normal, int k, float max_radius, Scratch& scratch) const;

  // From all photons of the disc.
  Estimate within(const glm::vec3& point, const glm::vec3& normal, float radius) const;

  std::size_t size() const;
  std::size_t photon_bytes() const;
  std::size_t tree_bytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lightwell
