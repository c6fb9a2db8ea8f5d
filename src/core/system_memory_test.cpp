#include "core/system_memory.h"

#include <fstream>

#include <gtest/gtest.h>

#include "core/test_folder.h"

namespace lightwell {
namespace {

class SystemMemory : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    const std::filesystem::path path = folder_.path(name);
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
  }
  std::uint64_t limit() const { return memory_limit(folder_.path()); }

  TestFolder folder_;
};

TEST_F(SystemMemory, IsTheMachinesWithoutGroups) {
  EXPECT_GT(limit(), std::uint64_t{64} << 20);
  EXPECT_LE(memory_limit(), limit());
}

TEST_F(SystemMemory, SmallestLimitOfAGroupAndItsParents) {
  write("proc/self/cgroup", "0::/user/job\n");
  write("sys/fs/cgroup/user/job/memory.max", "max\n");
  const std::uint64_t machine = limit();
  write("sys/fs/cgroup/user/memory.max", "7000000\n");
  EXPECT_EQ(limit(), 7000000u);
  write("sys/fs/cgroup/user/job/memory.max", "5000000\n");
  EXPECT_EQ(limit(), 5000000u);
  write("sys/fs/cgroup/user/job/memory.max", "9223372036854771712\n");
  write("sys/fs/cgroup/user/memory.max", "max\n");
  EXPECT_EQ(limit(), machine);
}

TEST_F(SystemMemory, InAContainerTheLimitLiesAtTheTop) {
  write("proc/self/cgroup", "0::/outside/abc\n");
  write("sys/fs/cgroup/memory.max", "6000000\n");
  EXPECT_EQ(limit(), 6000000u);
}

TEST_F(SystemMemory, FirstVersionOfGroups) {
  write("proc/self/cgroup", "5:cpu,cpuacct:/\n4:hugetlb,memory:/job\n0::/\n");
  write("sys/fs/cgroup/memory/job/memory.limit_in_bytes", "8000000\n");
  EXPECT_EQ(limit(), 8000000u);
}

}  // namespace
}  // namespace lightwell
