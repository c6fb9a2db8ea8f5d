#include "core/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>

#include "lightwell/error.h"

namespace lightwell {

namespace fs = std::filesystem;

namespace {

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

// Names of files that are being written, where a signal handler finds them: plain memory that is never freed.
struct PartialName {
  std::atomic<bool> taken{false};
  std::atomic<bool> written{false};  // path is complete
  std::array<char, 4096> path{};     // PATH_MAX
};
std::array<PartialName, 16> g_partial_names;  // threads beyond that go without

PartialName* register_partial(const std::string& path) {
  for (PartialName& name : g_partial_names) {
    if (path.size() >= name.path.size() || name.taken.exchange(true)) continue;
    std::memcpy(name.path.data(), path.c_str(), path.size() + 1);
    name.written = true;
    return &name;
  }
  return nullptr;
}

// A new file that disappears unless it is renamed. Its name looks like no picture, and stays short however long the
// final one is.
class PartialFile {
 public:
  PartialFile(const fs::path& folder, mode_t mode) {
    static std::atomic<unsigned> counter{0};
    const std::string name = ".lightwell-" + std::to_string(::getpid()) + "-" + std::to_string(counter++) + ".partial";
    path_ = (folder / name).string();
    registered_ = register_partial(path_);
    ::unlink(path_.c_str());  // of a process that had our number and was killed
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    error_ = descriptor_ < 0 ? errno : 0;
  }
  ~PartialFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!renamed_) ::unlink(path_.c_str());
    if (!registered_) return;
    registered_->written = false;
    registered_->taken = false;
  }
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  int descriptor() const { return descriptor_; }
  int error() const { return error_; }  // 0: all went well so far

  void write(std::span<const std::uint8_t> bytes) {
    while (error_ == 0 && !bytes.empty()) {
      const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
      if (count < 0 && errno != EINTR) error_ = errno;
      if (count > 0) bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
  }
  void rename(const fs::path& target) {
    if (error_ == 0 && ::close(std::exchange(descriptor_, -1)) != 0) error_ = errno;  // a full disk may show only here
    if (error_ == 0 && ::rename(path_.c_str(), target.c_str()) != 0) error_ = errno;
    renamed_ = error_ == 0;
  }

 private:
  std::string path_;
  PartialName* registered_ = nullptr;
  int descriptor_ = -1;
  int error_ = 0;
  bool renamed_ = false;
};

// The file that `path` means, which need not be there: symbolic links followed to their end.
fs::path target_of(const std::string& path) {
  constexpr int kMaxLinks = 40;  // as Linux
  fs::path target(path);
  std::error_code ec;
  for (int links = 0; fs::is_symlink(target, ec); ++links) {
    if (links == kMaxLinks) throw InputError(path, "too many symbolic links");
    target = target.parent_path() / fs::read_symlink(target, ec);
  }
  return target;
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

}  // namespace

std::vector<std::uint8_t> read_file(const std::string& path, std::uint64_t max_bytes) {
  struct stat status {};
  const auto check_kind = [&] {
    if (!S_ISREG(status.st_mode)) throw InputError(path, "not a regular file");
  };
  if (::stat(path.c_str(), &status) != 0)
    throw InputError(path, errno == ENOENT || errno == ENOTDIR ? "no such file" : std::strerror(errno));
  check_kind();  // before it is opened: devices may take that for a command
  // It may be another one by now. Opening a FIFO does not wait for its other end.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) throw InputError(path, std::strerror(errno));
  const File file(::fdopen(descriptor, "rb"));
  if (!file || ::fstat(descriptor, &status) != 0) throw InputError(path, std::strerror(errno));
  check_kind();
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size > max_bytes) throw InputError(path, "file of " + std::to_string(size) + " bytes is too large");
  std::vector<std::uint8_t> bytes(size);
  if (size > 0 && std::fread(bytes.data(), 1, bytes.size(), file.get()) != bytes.size())
    throw InputError(path, "could not read the whole file");
  return bytes;
}

void write_file_atomically(const std::string& path, std::span<const std::uint8_t> bytes) {
  check_writable(path);
  const fs::path target = target_of(path);
  struct stat old {};
  const bool overwrites = ::stat(target.c_str(), &old) == 0;
  PartialFile file(folder_of(target), overwrites ? 0600 : 0666);
  file.write(bytes);
  if (overwrites && file.error() == 0) {
    // Only root may give files away; others own what they write, as the new file's maker.
    [[maybe_unused]] const int ignored = ::fchown(file.descriptor(), old.st_uid, old.st_gid);
    ::fchmod(file.descriptor(), old.st_mode & 07777);
  }
  file.rename(target);
  if (file.error() != 0) throw InputError(path, std::string("could not be written: ") + std::strerror(file.error()));
}

void discard_partial_files() noexcept {
  for (const PartialName& name : g_partial_names)
    if (name.written) ::unlink(name.path.data());
}

void check_writable(const std::string& path) {
  if (path.empty()) throw InputError("output", "empty file name");
  const fs::path target = target_of(path);
  const fs::path folder = folder_of(target);
  std::error_code ec;
  if (!fs::is_directory(folder, ec)) throw InputError(path, "folder " + folder.string() + " does not exist");
  const fs::file_status status = fs::status(target, ec);
  if (ec && status.type() != fs::file_type::not_found) throw InputError(path, ec.message());
  if (fs::is_directory(status)) throw InputError(path, "is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status)) throw InputError(path, "is not a regular file");
  if (fs::exists(status) && ::access(target.c_str(), W_OK) != 0)
    throw InputError(path, std::string("cannot be overwritten: ") + std::strerror(errno));
  // Trying is the only sure way: permissions, read-only and special file systems all show.
  const PartialFile trial(folder, 0600);
  if (trial.error() != 0)
    throw InputError(path, "folder " + folder.string() + " is not writable: " + std::strerror(trial.error()));
}

}  // namespace lightwell
