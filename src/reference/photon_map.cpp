#include "reference/photon_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/ext/vector_uint3.hpp>
#include <glm/geometric.hpp>

#include "reference/nanoflann.h"
#include "reference/sampling.h"

namespace lightwell {
namespace {

constexpr std::size_t kPhotonsALeaf = 12;

// What nanoflann asks of a set of points.
struct PhotonCloud {
  std::vector<Photon> photons;

  std::size_t kdtree_get_point_count() const { return photons.size(); }
  float kdtree_get_pt(std::size_t index, std::size_t axis) const {
    return photons[index].position[static_cast<glm::length_t>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, PhotonCloud>, PhotonCloud, 3,
                                                 std::uint32_t>;

// Ten bits of x, 30 bits apart from each other by two places.
std::uint32_t spread_bits(std::uint32_t x) {
  x = (x | (x << 16)) & 0x030000ffu;
  x = (x | (x << 8)) & 0x0300f00fu;
  x = (x | (x << 4)) & 0x030c30c3u;
  return (x | (x << 2)) & 0x09249249u;
}

// Along a curve that fills the box of all photons (Morton 1966), so that neighbours in space are so in memory.
std::vector<Photon> sort_by_place(std::vector<Photon> photons) {
  if (photons.empty()) return photons;
  glm::vec3 minimum = photons.front().position;
  glm::vec3 maximum = minimum;
  for (const Photon& photon : photons) {
    minimum = glm::min(minimum, photon.position);
    maximum = glm::max(maximum, photon.position);
  }
  const glm::vec3 size = glm::max(maximum - minimum, glm::vec3{1e-30f});
  std::vector<std::pair<std::uint32_t, std::uint32_t>> order(photons.size());  // code, index
  for (std::size_t i = 0; i < photons.size(); ++i) {
    const glm::uvec3 cell{(photons[i].position - minimum) / size * 1023.0f};
    order[i] = {spread_bits(cell.x) | (spread_bits(cell.y) << 1) | (spread_bits(cell.z) << 2),
                static_cast<std::uint32_t>(i)};
  }
  std::sort(order.begin(), order.end());
  std::vector<Photon> sorted(photons.size());
  for (std::size_t i = 0; i < order.size(); ++i) sorted[i] = photons[order[i].second];
  return sorted;
}

// The disc about a point.
struct Disc {
  glm::vec3 point;
  glm::vec3 normal;

  float weight(const Photon& photon) const { return glm::dot(photon.normal, normal); }
  bool accepts(const Photon& photon) const { return weight(photon) >= PhotonMap::kLeastNormalCosine; }
  float distance_squared(const Photon& photon) const {
    const glm::vec3 offset = photon.position - point;
    const float height = glm::dot(offset, normal);
    const float height_part = height / PhotonMap::kDiscThickness;
    return std::max(glm::dot(offset, offset) - height * height, height_part * height_part);
  }
  // The ball around the flat cylinder of that radius.
  static float ball_squared(float radius_squared) {
    return radius_squared * (1.0f + PhotonMap::kDiscThickness * PhotonMap::kDiscThickness);
  }
};

struct IsNearer {
  bool operator()(const PhotonMap::Neighbor& a, const PhotonMap::Neighbor& b) const {
    return a.distance_squared < b.distance_squared;
  }
};

// The k nearest photons of a disc, the farthest in front (a heap), as nanoflann finds them.
class NearestPhotons {
 public:
  NearestPhotons(const std::vector<Photon>& photons, const Disc& disc, std::size_t k, float max_radius,
                 PhotonMap::Scratch& found)
      : photons_(photons), disc_(disc), k_(k), limit_(max_radius * max_radius), found_(found) {
    found_.clear();
  }

  bool full() const { return found_.size() == k_; }
  void sort() {}
  float worstDist() const { return Disc::ball_squared(limit_); }
  bool addPoint(float, std::uint32_t index) {
    const Photon& photon = photons_[index];
    const float distance_squared = disc_.distance_squared(photon);
    if (!(distance_squared < limit_) || !disc_.accepts(photon)) return true;
    if (full()) {
      std::pop_heap(found_.begin(), found_.end(), IsNearer{});
      found_.back() = {distance_squared, index};
    } else {
      found_.push_back({distance_squared, index});
    }
    std::push_heap(found_.begin(), found_.end(), IsNearer{});
    if (full()) limit_ = found_.front().distance_squared;
    return true;
  }

 private:
  const std::vector<Photon>& photons_;
  const Disc& disc_;
  std::size_t k_;
  float limit_;  // the disc's radius squared, so far
  PhotonMap::Scratch& found_;
};

// The sum over all photons of a disc.
class PhotonSum {
 public:
  PhotonSum(const std::vector<Photon>& photons, const Disc& disc, float radius)
      : photons_(photons), disc_(disc), limit_(radius * radius) {}

  bool full() const { return true; }
  void sort() {}
  float worstDist() const { return Disc::ball_squared(limit_); }
  bool addPoint(float, std::uint32_t index) {
    const Photon& photon = photons_[index];
    if (!(disc_.distance_squared(photon) < limit_) || !disc_.accepts(photon)) return true;
    flux += photon.flux * disc_.weight(photon);
    ++count;
    return true;
  }

  glm::vec3 flux{0.0f};
  int count = 0;

 private:
  const std::vector<Photon>& photons_;
  const Disc& disc_;
  float limit_;
};

PhotonMap::Estimate over_disc(const glm::vec3& flux, float radius, int photons) {
  if (!(radius > 0.0f)) return {};
  return {flux / (kPi * radius * radius), radius, photons};
}

}  // namespace

struct PhotonMap::State {
  explicit State(std::vector<Photon> photons)
      : cloud{sort_by_place(std::move(photons))},
        tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(kPhotonsALeaf)) {
    tree_bytes = tree.usedMemory(tree);
  }

  PhotonCloud cloud;
  Tree tree;
  std::size_t tree_bytes = 0;
};

PhotonMap::PhotonMap(std::vector<Photon> photons) : state_(new State(std::move(photons))) {}
PhotonMap::~PhotonMap() = default;
PhotonMap::PhotonMap(PhotonMap&&) noexcept = default;
PhotonMap& PhotonMap::operator=(PhotonMap&&) noexcept = default;

PhotonMap::Estimate PhotonMap::nearest(const glm::vec3& point, const glm::vec3& normal, int k, float max_radius,
                                       Scratch& scratch) const {
  if (size() == 0) return over_disc(glm::vec3{0.0f}, max_radius, 0);
  const std::vector<Photon>& photons = state_->cloud.photons;
  const Disc disc{point, normal};
  NearestPhotons neighbors(photons, disc, static_cast<std::size_t>(k), max_radius, scratch);
  find_neighbors(state_->tree, neighbors, &point.x);
  const bool full = neighbors.full();
  glm::vec3 flux{0.0f};
  for (std::size_t i = full ? 1 : 0; i < scratch.size(); ++i) {
    const Photon& photon = photons[scratch[i].photon];
    flux += photon.flux * disc.weight(photon);
  }
  return over_disc(flux, full ? std::sqrt(scratch.front().distance_squared) : max_radius,
                   static_cast<int>(scratch.size()) - (full ? 1 : 0));
}

PhotonMap::Estimate PhotonMap::within(const glm::vec3& point, const glm::vec3& normal, float radius) const {
  if (size() == 0) return over_disc(glm::vec3{0.0f}, radius, 0);
  const Disc disc{point, normal};
  PhotonSum sum(state_->cloud.photons, disc, radius);
  find_neighbors(state_->tree, sum, &point.x);
  return over_disc(sum.flux, radius, sum.count);
}

std::size_t PhotonMap::size() const {
  return state_->cloud.photons.size();
}
std::size_t PhotonMap::photon_bytes() const {
  return size() * sizeof(Photon);
}
std::size_t PhotonMap::tree_bytes() const {
  return state_->tree_bytes;
}

}  // namespace lightwell
