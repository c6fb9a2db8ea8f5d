#include "core/files.h"

#include <sys/mount.h>
#include <unistd.h>

#include <fstream>

#include <gtest/gtest.h>

#include "core/test_folder.h"
#include "lightwell/error.h"
#include "lightwell/image.h"

namespace lightwell {
namespace {

namespace fs = std::filesystem;

int count_files(const std::string& folder) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(folder)) count += entry.exists() ? 1 : 0;
  return count;
}

TEST(Files, WriteAndReadBack) {
  const TestFolder folder;
  const std::vector<std::uint8_t> bytes = {1, 2, 3};
  write_file_atomically(folder.path("a.bin"), bytes);
  EXPECT_EQ(read_file(folder.path("a.bin")), bytes);
  EXPECT_EQ(count_files(folder.path()), 1);
  EXPECT_THROW(read_file(folder.path("a.bin"), 2), InputError);
}

TEST(Files, FailureKeepsTheOldFileAndLeavesNoOther) {
  const TestFolder folder;
  const std::vector<std::uint8_t> bytes = {1, 2, 3};
  write_file_atomically(folder.path("a.bin"), bytes);
  const auto give_up = [](const std::string& temporary) {
    std::ofstream(temporary) << "half";
    throw std::runtime_error("no more");
  };
  EXPECT_THROW(write_file_atomically(folder.path("a.bin"), give_up), InputError);
  EXPECT_EQ(read_file(folder.path("a.bin")), bytes);
  EXPECT_EQ(count_files(folder.path()), 1);
}

TEST(Files, RefusesOutputsThatCannotBeWritten) {
  const TestFolder folder;
  EXPECT_THROW(check_writable(""), InputError);
  EXPECT_THROW(check_writable(folder.path()), InputError);
  EXPECT_THROW(check_writable(folder.path("none/a.exr")), InputError);
  EXPECT_THROW(check_writable("/dev/null"), InputError);      // would be replaced by a file
  EXPECT_THROW(check_writable("/proc/new.exr"), InputError);  // even for root
  EXPECT_NO_THROW(check_writable(folder.path("new.exr")));
  EXPECT_EQ(count_files(folder.path()), 0);
}

TEST(Files, RefusesReadOnlyOutputs) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const TestFolder folder;
  std::ofstream(folder.path("old.exr")) << "old";
  fs::permissions(folder.path("old.exr"), fs::perms::owner_read);
  EXPECT_THROW(check_writable(folder.path("old.exr")), InputError);
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THROW(check_writable(folder.path("new.exr")), InputError);
  fs::permissions(folder.path(), fs::perms::owner_all);
}

TEST(Files, FullDiskIsAnErrorWithoutAPartialFile) {
  const TestFolder folder;
  if (::mount("none", folder.path().c_str(), "tmpfs", 0, "size=64k") != 0)
    GTEST_SKIP() << "needs the right to mount a small file system";
  const Image image(256, 256, 3);
  Image noise = image;
  for (std::size_t i = 0; i < noise.pixels.size(); ++i) noise.pixels[i] = static_cast<float>((i * 2654435761u) % 65537);
  EXPECT_THROW(save_exr(folder.path("full.exr"), noise), InputError);
  EXPECT_EQ(count_files(folder.path()), 0);
  ::umount(folder.path().c_str());
}

}  // namespace
}  // namespace lightwell
