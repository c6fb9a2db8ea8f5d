// Pipelines on a real device whose driver fails when told to, and the file that the driver's cache is kept in.
#include "gpu/pipeline_cache.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <set>

#include "core/files.h"
#include "core/test_folder.h"
#include "gpu/pipeline_cache_file.h"
#include "gpu/testing/watched_host.h"
#include "lightwell/error.h"

namespace lightwell {
namespace {

// void main() {} with one thread a workgroup, SPIR-V 1.0.
constexpr std::uint32_t kNothing[] = {
    0x07230203, 0x00010000, 0,  6,          0,     // header, ids below 6
    0x00020011, 1,                                 // OpCapability Shader
    0x0003000e, 0,          1,                     // OpMemoryModel Logical GLSL450
    0x0005000f, 5,          1,  0x6e69616d, 0,     // OpEntryPoint GLCompute %1 "main"
    0x00060010, 1,          17, 1,          1, 1,  // OpExecutionMode %1 LocalSize 1 1 1
    0x00020013, 2,                                 // %2 = OpTypeVoid
    0x00030021, 3,          2,                     // %3 = OpTypeFunction %2
    0x00050036, 2,          1,  0,          3,     // %1 = OpFunction %2 None %3
    0x000200f8, 4,                                 // %4 = OpLabel
    0x000100fd,                                    // OpReturn
    0x00010038,                                    // OpFunctionEnd
};

class PipelineCacheTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (list_devices().empty()) GTEST_SKIP() << "no Vulkan device on this machine";
    owner_ = std::make_unique<Device>();
    host_ = std::make_unique<WatchedHost>(*owner_);
    lent_ = std::make_unique<Device>(host_->lend());
  }
  void TearDown() override {
    if (!host_) return;
    lent_.reset();
    EXPECT_EQ(host_->alive + host_->set_layouts_alive, 0) << "all that was made is destroyed";
  }

  WatchedHost& host() { return *host_; }
  PipelineCache& pipelines() { return lent_->pipelines(); }

  // Requests that differ in the value of a constant.
  std::vector<PipelineRequest> requests(std::uint32_t count) const {
    std::vector<PipelineRequest> list;
    for (std::uint32_t i = 0; i < count; ++i) list.push_back({{{&code_, &reflection_}}, {{0, i}}, {}});
    return list;
  }

 private:
  KernelCode code_{"nothing", kNothing};
  Reflection reflection_ = reflect(code_);
  std::unique_ptr<Device> owner_;
  std::unique_ptr<WatchedHost> host_;
  std::unique_ptr<Device> lent_;
};

TEST_F(PipelineCacheTest, EachIsMadeOnce) {
  const std::vector<const Pipeline*> first = pipelines().find_or_make(requests(20));
  ASSERT_EQ(first.size(), 20u);
  EXPECT_EQ(std::set(first.begin(), first.end()).size(), 20u);
  for (const Pipeline* pipeline : first) EXPECT_NE(pipeline->pipeline, VK_NULL_HANDLE);
  std::vector<PipelineRequest> twice = requests(20);
  twice.insert(twice.end(), twice.begin(), twice.begin() + 10);
  const std::vector<const Pipeline*> again = pipelines().find_or_make(twice);
  EXPECT_TRUE(std::equal(first.begin(), first.end(), again.begin()));
  EXPECT_TRUE(std::equal(again.begin() + 20, again.end(), again.begin()));
  EXPECT_EQ(pipelines().made_count(), 20u);
}

TEST_F(PipelineCacheTest, WhatFailedLeavesNothingBehindAndCanBeMadeLater) {
  host().failures = 1;
  try {
    pipelines().find_or_make(requests(1));
    FAIL();
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "Vulkan: out of GPU memory (-2) in vkCreateComputePipelines");
  }
  EXPECT_EQ(host().alive, 0) << "layouts and modules go with the pipeline";
  EXPECT_NE(pipelines().find_or_make(requests(1))[0]->pipeline, VK_NULL_HANDLE);
}

TEST_F(PipelineCacheTest, OneFailureCostsNoOtherPipeline) {
  host().failures = 1;
  EXPECT_THROW(pipelines().find_or_make(requests(8)), InputError);
  EXPECT_EQ(pipelines().made_count(), 7u);
  for (const Pipeline* pipeline : pipelines().find_or_make(requests(8))) EXPECT_NE(pipeline->pipeline, VK_NULL_HANDLE);
}

// ---- the file ----

std::vector<std::uint8_t> driver_data(std::size_t size) {
  std::vector<std::uint8_t> data(size);
  std::iota(data.begin(), data.end(), std::uint8_t{1});
  return data;
}

TEST(PipelineCacheFile, ComesBackAsItWas) {
  const TestFolder folder;
  const std::string path = folder.path("new/pipelines");
  EXPECT_TRUE(read_pipeline_data(path).empty());
  write_pipeline_data(path, driver_data(5000));
  EXPECT_EQ(read_pipeline_data(path), driver_data(5000));
}

TEST(PipelineCacheFile, ADamagedOneIsIgnored) {
  const TestFolder folder;
  const std::string path = folder.path("pipelines");
  write_pipeline_data(path, driver_data(5000));
  const std::vector<std::uint8_t> whole = read_file(path);
  for (const std::size_t size : {std::size_t{0}, std::size_t{10}, whole.size() / 2, whole.size() - 1}) {
    write_file_atomically(path, std::span(whole).first(size));
    EXPECT_TRUE(read_pipeline_data(path).empty()) << size << " bytes";
  }
  for (const std::size_t place : {std::size_t{3}, std::size_t{9}, std::size_t{17}, whole.size() - 1}) {
    std::vector<std::uint8_t> damaged = whole;
    damaged[place] ^= 0x40;
    write_file_atomically(path, damaged);
    EXPECT_TRUE(read_pipeline_data(path).empty()) << "byte " << place;
  }
}

TEST(PipelineCacheFile, NoneWhereTheDriverKeepsNothing) {
  const TestFolder folder;
  write_pipeline_data(folder.path("pipelines"), driver_data(sizeof(VkPipelineCacheHeaderVersionOne)));
  EXPECT_FALSE(std::filesystem::exists(folder.path("pipelines")));
}

TEST(PipelineCacheFile, AFolderThatCannotBeWrittenIsNoError) {
  const TestFolder folder;
  write_file_atomically(folder.path("file"), driver_data(1));
  EXPECT_NO_THROW(write_pipeline_data(folder.path("file/pipelines"), driver_data(5000)));
}

TEST(PipelineCacheFile, OneADeviceAndDriver) {
  const char* home = std::getenv("XDG_CACHE_HOME");
  const std::string saved = home ? home : "";
  ::setenv("XDG_CACHE_HOME", "/caches", 1);
  VkPhysicalDeviceProperties properties{};
  const std::string path = pipeline_cache_path(properties);
  EXPECT_EQ(path.rfind("/caches/lightwell/", 0), 0u) << path;
  properties.driverVersion = 2;
  EXPECT_NE(pipeline_cache_path(properties), path);
  properties.driverVersion = 0;
  properties.pipelineCacheUUID[15] = 1;
  EXPECT_NE(pipeline_cache_path(properties), path);
  if (home)
    ::setenv("XDG_CACHE_HOME", saved.c_str(), 1);
  else
    ::unsetenv("XDG_CACHE_HOME");
}

}  // namespace
}  // namespace lightwell
