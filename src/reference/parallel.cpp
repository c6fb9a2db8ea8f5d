#include "reference/parallel.h"

#include <algorithm>

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace lightwell {
namespace {

constexpr int kTileSide = 16;  // pixels

int tiles_across(int pixels) {
  return (pixels + kTileSide - 1) / kTileSide;
}

}  // namespace

int core_count(int threads) {
  const int cores = tbb::info::default_concurrency();
  return threads > 0 ? std::min(threads, cores) : cores;
}

void run_parallel(int threads, int count, const std::function<void(int)>& work) {
  tbb::task_arena arena(core_count(threads));
  arena.execute([&] { tbb::parallel_for(0, count, work, tbb::simple_partitioner{}); });
}

void ProgressSteps::step() {
  if (!progress_) return;
  const std::lock_guard lock(mutex_);
  progress_(static_cast<float>(++done_) / static_cast<float>(steps_));
}

Tiles::Tiles(int width, int height)
    : width_(width), height_(height), columns_(tiles_across(width)), rows_(tiles_across(height)) {}

void Tiles::for_each_pixel(int index, const std::function<void(int, int)>& visit) const {
  const int left = index % columns_ * kTileSide;
  const int top = index / columns_ * kTileSide;
  for (int y = top; y < std::min(top + kTileSide, height_); ++y) {
    for (int x = left; x < std::min(left + kTileSide, width_); ++x) visit(x, y);
  }
}

}  // namespace lightwell
