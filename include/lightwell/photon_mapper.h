// A second truth: a photon mapper on the CPU (Jensen 1996), independent of all GPU code. It meets light from the other
// end than the path tracer does; direct light is the path tracer's.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "lightwell/options.h"
#include "lightwell/picture.h"
#include "lightwell/scene.h"

namespace lightwell {

struct PhotonMapperOptions {
  int width = 512;         // pixels, [1, kMaxImageSide]
  int height = 512;        // pixels, [1, kMaxImageSide]
  int photons = 250000;    // that lights send an iteration; each leaves a photon at every surface after the first
  int k = 100;             // photons that an estimate of irradiance is made of, [2, 100000]
  int progressive = 1;     // iterations; the more, the smaller the discs of later ones
  int samples = 16;        // camera rays a pixel and iteration
  int max_bounces = 1024;  // at most this many bounces in Picture::indirect; 0: indirect is black
  int seed = 1;
  int threads = 0;  // 0: all cores, and never more; the picture does not depend on it

  // The options above but the size, which belongs to every renderer.
  void describe(OptionVisitor& visitor);
};

// Times are of the wall; those of work that cores do in turns are the cores' time divided by their number.
struct PhotonMapperStatistics {
  int threads = 0;
  std::int64_t emitted = 0;  // photons that lights sent
  std::int64_t stored = 0;   // that surfaces keep; both in all iterations
  double emission_ms = 0.0;  // tracing photons
  double tree_ms = 0.0;      // building kd-trees
  double camera_ms = 0.0;    // camera rays and direct light
  double query_ms = 0.0;     // estimates of irradiance
  double wall_time_ms = 0.0;
  std::int64_t queries = 0;
  double us_per_query = 0.0;  // of one core
  double photons_per_query = 0.0;
  std::int64_t photons_kept = 0;   // at a time: in the iteration that stored most of them
  std::uint64_t photon_bytes = 0;  // of those
  std::uint64_t tree_bytes = 0;    // of the kd-tree over those
};

struct PhotonMapping {
  Picture picture;
  PhotonMapperStatistics statistics;
};

// Photons start at lights of every kind in proportion to their power, bounce as Russian roulette says, and stay at each
// surface but the first. Irradiance of indirect light at a visible point is the flux of the k nearest photons whose
// surface looks the same way, over the disc that holds them; there is no final gathering, so blur and dark edges of
// width of that disc show.
//
// With more than one iteration every one has photons of its own, and the picture is the mean over iterations. The first
// one finds each pixel's disc; in iteration i its area is that of the one before times (i - 1 + 2/3) / i, so noise and
// blur vanish both (Knaus and Zwicker 2011). There rays measure how much of a disc is surface, so edges are not dark.
class PhotonMapper {
 public:
  // Builds the ray tracing structure of all instances of `snapshot`. `scene` must outlive the mapper: its textures are
  // read in place. Throws InputError if Embree cannot be used.
  PhotonMapper(const Scene& scene, const SceneSnapshot& snapshot);
  ~PhotonMapper();
  PhotonMapper(PhotonMapper&&) noexcept;
  PhotonMapper& operator=(PhotonMapper&&) noexcept;

  // The same picture for the same options on the same machine, whatever the number of threads. `progress` is given the
  // part done in (0, 1], from a worker thread, one call at a time; an exception from it ends the rendering. What the
  // camera sees is as for the path tracer. Throws InputError if an option is out of range.
  PhotonMapping render(const WorldCamera& camera, const PhotonMapperOptions& options,
                       const std::function<void(float)>& progress = {}) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lightwell
