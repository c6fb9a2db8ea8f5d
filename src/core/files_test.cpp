#include "core/files.h"

#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
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

// While it lives this process may write files of `bytes` only.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &old_); }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit old_{};
};

TEST(Files, FailureKeepsTheOldFileAndLeavesNoOther) {
  const TestFolder folder;
  const std::vector<std::uint8_t> bytes = {1, 2, 3};
  write_file_atomically(folder.path("a.bin"), bytes);
  const auto old_handler = ::signal(SIGXFSZ, SIG_IGN);
  {
    const FileSizeLimit limit(1000);
    EXPECT_THROW(write_file_atomically(folder.path("a.bin"), std::vector<std::uint8_t>(2000)), InputError);
  }
  ::signal(SIGXFSZ, old_handler);
  EXPECT_EQ(read_file(folder.path("a.bin")), bytes);
  EXPECT_EQ(count_files(folder.path()), 1);
}

// The signal comes in the middle of writing, when the limit is reached.
TEST(Files, SignalHandlersCanDiscardWhatIsBeingWritten) {
  const TestFolder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, [](int) {
      discard_partial_files();
      ::_exit(7);
    });
    const FileSizeLimit limit(1000);
    write_file_atomically(folder.path("a.exr"), std::vector<std::uint8_t>(2000));
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 7);
  EXPECT_EQ(count_files(folder.path()), 0);
}

// What a process leaves that was killed outright.
TEST(Files, UnfinishedFilesLookLikeNoPicture) {
  const TestFolder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_DFL);
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    const FileSizeLimit limit(1000);
    write_file_atomically(folder.path("a.exr"), std::vector<std::uint8_t>(2000));
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(WTERMSIG(status), SIGXFSZ);
  ASSERT_EQ(count_files(folder.path()), 1);
  EXPECT_EQ(fs::directory_iterator(folder.path())->path().extension(), ".partial");
}

TEST(Files, OverwritingFollowsLinksAndKeepsTheMode) {
  const TestFolder folder;
  const std::vector<std::uint8_t> old_bytes = {1}, bytes = {1, 2, 3};
  fs::create_directory(folder.path("store"));
  write_file_atomically(folder.path("store/real.exr"), old_bytes);
  fs::permissions(folder.path("store/real.exr"), fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("store/real.exr", folder.path("link.exr"));
  fs::create_symlink("link.exr", folder.path("second.exr"));
  write_file_atomically(folder.path("second.exr"), bytes);
  EXPECT_TRUE(fs::is_symlink(folder.path("second.exr")));
  EXPECT_TRUE(fs::is_symlink(folder.path("link.exr")));
  EXPECT_EQ(read_file(folder.path("store/real.exr")), bytes);
  EXPECT_EQ(fs::status(folder.path("store/real.exr")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  // To no file yet, and round in a circle.
  fs::create_symlink("store/new.exr", folder.path("hollow.exr"));
  write_file_atomically(folder.path("hollow.exr"), bytes);
  EXPECT_EQ(read_file(folder.path("store/new.exr")), bytes);
  fs::create_symlink("circle.exr", folder.path("circle.exr"));
  EXPECT_THROW(write_file_atomically(folder.path("circle.exr"), bytes), InputError);
}

TEST(Files, NamesMayBeAsLongAsTheSystemAllows) {
  const TestFolder folder;
  const std::string name = folder.path(std::string(251, 'x') + ".exr");
  write_file_atomically(name, std::vector<std::uint8_t>{1});
  EXPECT_EQ(read_file(name).size(), 1u);
}

TEST(Files, ReadsRegularFilesOnlyAndWaitsForNothing) {
  const TestFolder folder;
  ASSERT_EQ(::mkfifo(folder.path("fifo").c_str(), 0600), 0);
  for (const std::string& path : {folder.path("fifo"), folder.path(), std::string("/dev/zero")})
    EXPECT_THROW(read_file(path), InputError) << path;
  EXPECT_THROW(read_file(folder.path("none")), InputError);
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
