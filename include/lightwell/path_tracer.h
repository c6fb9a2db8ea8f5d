// The ground truth: a unidirectional path tracer on the CPU (Kajiya 1986), independent of all GPU code.
#pragma once

#include <functional>
#include <memory>

#include "lightwell/options.h"
#include "lightwell/picture.h"
#include "lightwell/scene.h"

namespace lightwell {

struct PathTracerOptions {
  int width = 512;   // pixels, [1, kMaxImageSide]
  int height = 512;  // pixels, [1, kMaxImageSide]
  int samples = 64;  // paths a pixel; the error falls with 1 / sqrt(samples)
  // At most this many bounces in Picture::indirect; 0: indirect is black. The default is the most there can be, which
  // nothing reaches that absorbs 2 % of its light: roulette ends paths.
  int max_bounces = 1024;
  bool variance = false;  // also Picture::variance, of 2 samples and more; costs up to a quarter more noise
  int seed = 1;
  int threads = 0;  // 0: all cores, and never more; the picture does not depend on it

  // The options above but the size, which belongs to every renderer.
  void describe(OptionVisitor& visitor);
};

// Next-event estimation of every light type, combined with cosine sampling by multiple importance sampling (Veach
// 1997, Ch. 9); unbiased Russian roulette after four bounces, which at most 98 % survive. Surfaces are Lambert and
// reflect on both sides.
class PathTracer {
 public:
  // Builds the ray tracing structure of all instances of `snapshot`. `scene` must outlive the tracer: its textures are
  // read in place. Throws InputError if Embree cannot be used.
  PathTracer(const Scene& scene, const SceneSnapshot& snapshot);
  ~PathTracer();
  PathTracer(PathTracer&&) noexcept;
  PathTracer& operator=(PathTracer&&) noexcept;

  // The same bytes for the same options on the same machine, whatever the number of threads. `progress` is given the
  // part done in (0, 1], from a worker thread, one call at a time; an exception from it ends the rendering. Pixels are
  // square; nothing nearer than the camera's znear is seen, zfar is not used. Throws InputError if an option is out of
  // range. Where more than 0.1 % of the light is estimated to lie beyond max_bounces (1 and more), the log is told how
  // much.
  Picture render(const WorldCamera& camera, const PathTracerOptions& options,
                 const std::function<void(float)>& progress = {}) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lightwell
