// Choice of device (pure), and memory accounting on a real one.
#include "gpu/device.h"

#include <gtest/gtest.h>

#include "gpu/device_select.h"
#include "gpu/submit.h"
#include "gpu/testing/watched_host.h"
#include "lightwell/error.h"

namespace lightwell {
namespace {

CandidateDevice candidate(const char* name, VkPhysicalDeviceType type, std::vector<std::string> missing = {}) {
  CandidateDevice c;
  c.type = type;
  c.summary = {name, "driver", "", std::move(missing)};
  return c;
}

const std::vector<CandidateDevice> kDevices = {
    candidate("Old Card", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, {"dynamicRendering"}),
    candidate("New Card", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU),
    candidate("llvmpipe", VK_PHYSICAL_DEVICE_TYPE_CPU),
};

std::string refusal(const std::vector<CandidateDevice>& devices, const std::string& wanted) {
  try {
    choose_device(devices, wanted);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(DeviceChoice, TakesTheFirstUsableAndSaysWhy) {
  EXPECT_EQ(choose_device(kDevices, "").index, 1u);
  EXPECT_EQ(choose_device(kDevices, "best").index, 1u);
  const DeviceChoice software = choose_device({kDevices[2]}, "");
  EXPECT_NE(software.reason.find("software"), std::string::npos);
}

TEST(DeviceChoice, ByNameNumberAndKind) {
  EXPECT_EQ(choose_device(kDevices, "new card").index, 1u);
  EXPECT_EQ(choose_device(kDevices, "2").index, 2u);
  EXPECT_EQ(choose_device(kDevices, "cpu").index, 2u);
}

TEST(DeviceChoice, RefusalsNameTheDeviceAndWhatItLacks) {
  EXPECT_EQ(refusal(kDevices, "old"), "device 'old': Old Card lacks dynamicRendering");
  EXPECT_NE(refusal(kDevices, "voodoo").find("no such device; there is: Old Card"), std::string::npos);
  EXPECT_NE(refusal({kDevices[0]}, "").find("no usable device"), std::string::npos);
  EXPECT_NE(refusal({}, "").find("mesa-vulkan-drivers"), std::string::npos);
}

TEST(VulkanErrors, NameTheCall) {
  try {
    check_vk(VK_ERROR_OUT_OF_DEVICE_MEMORY, "device.vk().vkCreateImage(device.handle(), &info, nullptr, &handle_)");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "Vulkan: out of GPU memory (-2) in vkCreateImage");
  }
}

// Waiting for a device needs all its queues, and they are the host's.
TEST(LentDevice, IsNeitherWaitedForNorDestroyed) {
  if (list_devices().empty()) GTEST_SKIP() << "no Vulkan device on this machine";
  const Device owner;
  WatchedHost host(owner);
  { Device lent(host.lend()); }
  EXPECT_EQ(host.meddling, 0);
}

TEST(Submitter, RunsAgainAfterARecordingThatThrew) {
  if (list_devices().empty()) GTEST_SKIP() << "no Vulkan device on this machine";
  Device device(DeviceOptions{.device = "", .validation = true});
  Submitter submitter(device);
  EXPECT_THROW(submitter.run([](VkCommandBuffer) { throw InputError("frame", "refused"); }), InputError);
  bool recorded = false;
  submitter.run([&](VkCommandBuffer) { recorded = true; });
  EXPECT_TRUE(recorded);
  EXPECT_EQ(device.validation_messages(), std::vector<std::string>());
}

TEST(Memory, EveryByteIsUnderItsNameAndComesBack) {
  if (list_devices().empty()) GTEST_SKIP() << "no Vulkan device on this machine";
  Device device;
  const std::uint64_t before = device.memory().total_bytes();
  {
    const Buffer a(device, "voxels", 1000, MemoryKind::kDevice);
    const Buffer b(device, "voxels", 5000, MemoryKind::kDevice);
    const Buffer host(device, "staging", 100, MemoryKind::kHostUpload);
    ASSERT_NE(host.mapped(), nullptr);
    const auto report = device.memory().report();
    EXPECT_EQ(report.at("voxels").count, 2u);
    EXPECT_GE(report.at("voxels").bytes, 6000u);
    EXPECT_EQ(device.memory().total_bytes() - before, report.at("voxels").bytes + report.at("staging").bytes);
  }
  EXPECT_EQ(device.memory().total_bytes(), before);
  EXPECT_EQ(device.memory().report().at("voxels").count, 0u);
}

TEST(Memory, ABufferThatNoDeviceHoldsIsOneLine) {
  if (list_devices().empty()) GTEST_SKIP() << "no Vulkan device on this machine";
  Device device;
  try {
    const Buffer huge(device, "huge", device.largest_buffer() + 1, MemoryKind::kDevice);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()).find("GPU memory: huge need "), 0u) << e.what();
  }
}

TEST(Memory, ComesBackWithTheFramesThatUseIt) {
  if (list_devices().empty()) GTEST_SKIP() << "no Vulkan device on this machine";
  Device device;
  FrameTimeline frames(device.deferred());
  auto buffer = std::make_unique<Buffer>(device, "voxels", 1000, MemoryKind::kDevice);
  frames.begin_frame(1, 0);
  frames.add_use(buffer->uses);
  buffer.reset();
  frames.begin_frame(2, 0);
  EXPECT_EQ(device.memory().report().at("voxels").count, 1u);
  frames.begin_frame(3, 1);
  EXPECT_EQ(device.memory().report().at("voxels").count, 0u);
}

TEST(Memory, FreedRangesAreUsedAgain) {
  if (list_devices().empty()) GTEST_SKIP() << "no Vulkan device on this machine";
  Device device;
  std::uint64_t reserved = 0;
  for (std::uint64_t round = 1; round <= 20; ++round) {
    std::vector<std::unique_ptr<Buffer>> buffers;
    for (int i = 0; i < 10; ++i)
      buffers.push_back(std::make_unique<Buffer>(device, "round", 1u << (10 + i), MemoryKind::kDevice));
    if (round == 2) reserved = device.memory().reserved_bytes();
    buffers.clear();
  }
  EXPECT_LE(device.memory().reserved_bytes(), reserved);
}

}  // namespace
}  // namespace lightwell
