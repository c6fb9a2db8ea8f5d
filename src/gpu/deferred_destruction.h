// Destruction that waits for the GPU: an object goes when the frames that use it are done, and no later.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace lightwell {

// A frame of a timeline. Timelines are never numbered twice.
struct FrameUse {
  std::uint64_t timeline = 0;
  std::uint64_t frame = 0;
};

// The frames that may still use an object: the last one of each timeline.
using FrameUses = std::vector<FrameUse>;

// Knows how far each timeline has come on the GPU. A timeline is a sequence of frames 1, 2, ... that are done in that
// order; those of different timelines have nothing to do with each other.
class DeferredDestruction {
 public:
  std::uint64_t open_timeline();
  // All frames of the timeline are done, or never reached the GPU.
  void close_timeline(std::uint64_t timeline);
  // Frames up to and including `frame` are done.
  void complete(std::uint64_t timeline, std::uint64_t frame);

  // Adds a use, in place of those that are done.
  void add_use(FrameUses& uses, const FrameUse& use) const;
  // Runs `destroy` when all of `uses` are done: at once, or from complete() or close_timeline().
  void defer(FrameUses uses, std::function<void()> destroy);

  bool has_open_timelines() const { return !open_.empty(); }

 private:
  struct Timeline {
    std::uint64_t number = 0;
    std::uint64_t completed = 0;
  };
  struct Waiting {
    FrameUses uses;
    std::function<void()> destroy;
  };
  bool is_done(const FrameUse& use) const;
  void run_ready();

  std::vector<Timeline> open_;  // a closed one is done with everything
  std::vector<Waiting> waiting_;
  std::uint64_t last_number_ = 0;
};

// A timeline for as long as it lives. When it goes, all its frames are done.
class FrameTimeline {
 public:
  explicit FrameTimeline(DeferredDestruction& deferred) : deferred_(deferred), number_(deferred.open_timeline()) {}
  ~FrameTimeline() { deferred_.close_timeline(number_); }
  FrameTimeline(const FrameTimeline&) = delete;
  FrameTimeline& operator=(const FrameTimeline&) = delete;

  // Frame `frame` starts to be recorded; those up to and including `completed` are done on the GPU.
  void begin_frame(std::uint64_t frame, std::uint64_t completed) {
    deferred_.complete(number_, completed);
    frame_ = frame;
  }
  // The frame being recorded uses the object.
  void add_use(FrameUses& uses) const { deferred_.add_use(uses, {number_, frame_}); }

 private:
  DeferredDestruction& deferred_;
  std::uint64_t number_;
  std::uint64_t frame_ = 0;
};

}  // namespace lightwell
