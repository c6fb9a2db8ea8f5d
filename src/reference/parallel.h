// Work on all cores whose result does not depend on how many there are.
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>

namespace lightwell {

// How many cores `threads` means: 0 is all of them, and there are never more.
int core_count(int threads);

// Calls work(i) once for every i in [0, count), several at a time on core_count(threads) cores. An exception ends it.
void run_parallel(int threads, int count, const std::function<void(int)>& work);

// Tells `progress`, if there is one, what part of `steps` equal steps is done: one call at a time, from any thread.
class ProgressSteps {
 public:
  ProgressSteps(const std::function<void(float)>& progress, std::int64_t steps) : progress_(progress), steps_(steps) {}
  void step();

 private:
  const std::function<void(float)>& progress_;
  std::int64_t steps_;
  std::int64_t done_ = 0;
  std::mutex mutex_;
};

// A picture cut into squares, what one core takes at a time.
class Tiles {
 public:
  Tiles(int width, int height);
  int count() const { return columns_ * rows_; }
  // Calls visit(x, y) for every pixel of tile `index`, row by row.
  void for_each_pixel(int index, const std::function<void(int, int)>& visit) const;

 private:
  int width_, height_, columns_, rows_;
};

}  // namespace lightwell
