// Which frames an object waits for. No device is needed.
#include "gpu/deferred_destruction.h"

#include <gtest/gtest.h>

#include <optional>

namespace lightwell {
namespace {

// An object that says whether it is still there.
struct Object {
  FrameUses uses;
  bool alive = true;

  void let_go(DeferredDestruction& deferred) {
    deferred.defer(uses, [this] { alive = false; });
  }
};

TEST(DeferredDestruction, WhatNoFrameUsesGoesAtOnce) {
  DeferredDestruction deferred;
  FrameTimeline frames(deferred);
  frames.begin_frame(1, 0);
  Object object;
  object.let_go(deferred);
  EXPECT_FALSE(object.alive);
}

TEST(DeferredDestruction, WaitsForTheLastFrameThatUsesIt) {
  DeferredDestruction deferred;
  FrameTimeline frames(deferred);
  Object object;
  for (std::uint64_t frame = 1; frame <= 2; ++frame) {
    frames.begin_frame(frame, 0);
    frames.add_use(object.uses);
  }
  object.let_go(deferred);
  frames.begin_frame(3, 1);
  EXPECT_TRUE(object.alive);
  frames.begin_frame(4, 2);
  EXPECT_FALSE(object.alive);
}

// Each timeline counts for itself: a number of one says nothing about the other.
TEST(DeferredDestruction, NumbersOfOneTimelineDoNotFreeWhatAnotherUses) {
  DeferredDestruction deferred;
  FrameTimeline old(deferred);
  FrameTimeline young(deferred);
  Object object;
  old.begin_frame(1000, 998);
  young.begin_frame(3, 1);
  young.add_use(object.uses);
  object.let_go(deferred);
  old.begin_frame(1001, 999);
  EXPECT_TRUE(object.alive) << "frame 3 of the other timeline is in flight";
  young.begin_frame(4, 3);
  EXPECT_FALSE(object.alive);
}

TEST(DeferredDestruction, WaitsForAllTimelinesThatUseIt) {
  DeferredDestruction deferred;
  FrameTimeline first(deferred);
  FrameTimeline second(deferred);
  Object object;
  first.begin_frame(1, 0);
  first.add_use(object.uses);
  second.begin_frame(1, 0);
  second.add_use(object.uses);
  object.let_go(deferred);
  first.begin_frame(2, 1);
  EXPECT_TRUE(object.alive);
  second.begin_frame(2, 1);
  EXPECT_FALSE(object.alive);
}

// A renderer closed after thousands of frames, beside one that has just begun.
TEST(DeferredDestruction, AClosedTimelineHoldsNothingBack) {
  DeferredDestruction deferred;
  std::optional<FrameTimeline> closing(deferred);
  FrameTimeline other(deferred);
  other.begin_frame(1, 0);
  Object waits;
  Object goes_at_once;
  closing->begin_frame(5000, 4998);
  closing->add_use(waits.uses);
  closing->add_use(goes_at_once.uses);
  waits.let_go(deferred);
  EXPECT_TRUE(waits.alive);
  closing.reset();
  EXPECT_FALSE(waits.alive);
  goes_at_once.let_go(deferred);
  EXPECT_FALSE(goes_at_once.alive);
}

// Nobody says that the last frames of an idle timeline are done.
TEST(DeferredDestruction, AnIdleTimelineHoldsOnlyWhatItUses) {
  DeferredDestruction deferred;
  FrameTimeline idle(deferred);
  FrameTimeline busy(deferred);
  idle.begin_frame(1, 0);
  Object object;
  busy.begin_frame(1, 0);
  busy.add_use(object.uses);
  object.let_go(deferred);
  busy.begin_frame(2, 1);
  EXPECT_FALSE(object.alive);
}

TEST(DeferredDestruction, UsesDoNotPileUp) {
  DeferredDestruction deferred;
  Object object;
  for (int i = 0; i < 100; ++i) {
    FrameTimeline frames(deferred);
    frames.begin_frame(1, 0);
    frames.add_use(object.uses);
    EXPECT_EQ(object.uses.size(), 1u);
  }
}

TEST(DeferredDestruction, WhatIsDestroyedMayDeferInTurn) {
  DeferredDestruction deferred;
  FrameTimeline frames(deferred);
  Object owner;
  Object owned;
  frames.begin_frame(1, 0);
  frames.add_use(owner.uses);
  deferred.defer(owner.uses, [&] { owned.let_go(deferred); });
  frames.begin_frame(2, 1);
  EXPECT_FALSE(owned.alive);
}

}  // namespace
}  // namespace lightwell
