// Base of tests that need a device: one device a test program, validation on. Without any Vulkan device the test is
// skipped by name; a validation message fails it.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "gpu/device.h"
#include "lightwell/error.h"

namespace lightwell {

class DeviceTest : public ::testing::Test {
 protected:
  static Device* shared_device() {
    static const std::unique_ptr<Device> device = [] {
      if (list_devices().empty()) return std::unique_ptr<Device>();
      return std::make_unique<Device>(DeviceOptions{.device = "", .validation = true});
    }();
    return device.get();
  }

  DeviceTest() {
    if (shared_device()) messages_before_ = device().validation_messages().size();
  }
  static Device& device() { return *shared_device(); }

  void SetUp() override {
    if (!shared_device()) GTEST_SKIP() << "no Vulkan device on this machine";
  }
  void TearDown() override {
    if (!shared_device()) return;
    const auto& messages = device().validation_messages();
    for (std::size_t i = messages_before_; i < messages.size(); ++i) ADD_FAILURE() << messages[i];
  }

 private:
  std::size_t messages_before_ = 0;
};

}  // namespace lightwell
