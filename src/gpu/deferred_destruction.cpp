#include "gpu/deferred_destruction.h"

#include <algorithm>
#include <utility>

namespace lightwell {

std::uint64_t DeferredDestruction::open_timeline() {
  open_.push_back({++last_number_, 0});
  return last_number_;
}

void DeferredDestruction::close_timeline(std::uint64_t timeline) {
  std::erase_if(open_, [&](const Timeline& t) { return t.number == timeline; });
  run_ready();
}

void DeferredDestruction::complete(std::uint64_t timeline, std::uint64_t frame) {
  for (Timeline& t : open_)
    if (t.number == timeline) t.completed = std::max(t.completed, frame);
  run_ready();
}

bool DeferredDestruction::is_done(const FrameUse& use) const {
  return std::none_of(open_.begin(), open_.end(),
                      [&](const Timeline& t) { return t.number == use.timeline && t.completed < use.frame; });
}

void DeferredDestruction::add_use(FrameUses& uses, const FrameUse& use) const {
  std::erase_if(uses, [&](const FrameUse& u) { return u.timeline == use.timeline || is_done(u); });
  uses.push_back(use);
}

void DeferredDestruction::defer(FrameUses uses, std::function<void()> destroy) {
  std::erase_if(uses, [&](const FrameUse& u) { return is_done(u); });
  if (uses.empty()) return destroy();
  waiting_.push_back({std::move(uses), std::move(destroy)});
}

void DeferredDestruction::run_ready() {
  // Taken out first: what is destroyed may defer in turn.
  const auto ready = std::stable_partition(waiting_.begin(), waiting_.end(), [&](const Waiting& w) {
    return std::any_of(w.uses.begin(), w.uses.end(), [&](const FrameUse& u) { return !is_done(u); });
  });
  std::vector<Waiting> gone(std::make_move_iterator(ready), std::make_move_iterator(waiting_.end()));
  waiting_.erase(ready, waiting_.end());
  for (Waiting& w : gone) w.destroy();
}

}  // namespace lightwell
