#include "passes/trace/choose_tracing.h"

#include "graph/testing/device_test.h"

namespace lightwell {
namespace {

class ChooseTracingTest : public DeviceTest {};

TEST_F(ChooseTracingTest, MeasuresOnceAndOnlyWhereThereIsAChoice) {
  const Tracing first = choose_tracing(device());
  EXPECT_EQ(device().prefers_ray_query.has_value(), device().has_ray_query());
  EXPECT_TRUE(device().has_ray_query() || first == Tracing::kBvh);
  EXPECT_EQ(choose_tracing(device()), first);
}

TEST_F(ChooseTracingTest, WhatWasMeasuredDecides) {
  if (!device().has_ray_query()) GTEST_SKIP() << device().summary().name << " has no ray queries";
  const std::optional<bool> measured = device().prefers_ray_query;
  for (const bool faster : {false, true}) {
    device().prefers_ray_query = faster;
    EXPECT_EQ(choose_tracing(device()), faster ? Tracing::kRayQuery : Tracing::kBvh);
  }
  device().prefers_ray_query = measured;
}

}  // namespace
}  // namespace lightwell
