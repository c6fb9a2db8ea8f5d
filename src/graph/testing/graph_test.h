// Base of tests that run whole graphs and look at what came back.
#pragma once

#include <cstring>
#include <optional>
#include <vector>

#include "gpu/submit.h"
#include "graph/executor.h"
#include "graph/testing/device_test.h"

namespace lightwell {

class GraphTest : public DeviceTest {
 protected:
  void SetUp() override {
    DeviceTest::SetUp();
    if (IsSkipped()) return;
    executor_.emplace(device());
    submitter_.emplace(device());
  }

  GraphExecutor& executor() { return *executor_; }

  void run(FrameGraph& graph) {
    submitter_->run([&](VkCommandBuffer commands) { frame_ = executor_->record(graph, commands, frame_); });
  }

  // Of the last run.
  template <class T>
  std::vector<T> fetch(const ReadbackTicket& ticket) {
    const std::vector<std::byte> bytes = executor_->fetch(frame_, ticket);
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    return values;
  }

  std::uint64_t frame_ = 0;

 private:
  std::optional<GraphExecutor> executor_;
  std::optional<Submitter> submitter_;
};

}  // namespace lightwell
