#include "core/files.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "lightwell/error.h"

namespace lightwell {

namespace fs = std::filesystem;

namespace {

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

// The extension stays last: image libraries choose the format by it.
std::string temporary_name(const std::string& path) {
  const fs::path p(path);
  return (p.parent_path() / (p.stem().string() + ".partial" + std::to_string(::getpid()) + p.extension().string()))
      .string();
}

}  // namespace

std::vector<std::uint8_t> read_file(const std::string& path, std::uint64_t max_bytes) {
  std::error_code ec;
  const fs::file_status status = fs::status(path, ec);
  if (!fs::exists(status)) throw InputError(path, "no such file");
  if (!fs::is_regular_file(status)) throw InputError(path, "not a regular file");
  File file(std::fopen(path.c_str(), "rb"));
  if (!file) throw InputError(path, std::strerror(errno));
  const std::uint64_t size = fs::file_size(path, ec);
  if (ec) throw InputError(path, ec.message());
  if (size > max_bytes) throw InputError(path, "file of " + std::to_string(size) + " bytes is too large");
  std::vector<std::uint8_t> bytes(size);
  if (size > 0 && std::fread(bytes.data(), 1, bytes.size(), file.get()) != bytes.size())
    throw InputError(path, "could not read the whole file");
  return bytes;
}

void write_file_atomically(const std::string& path, const std::function<void(const std::string&)>& write) {
  const std::string temporary = temporary_name(path);
  const auto discard = [&] {
    std::error_code ignored;
    fs::remove(temporary, ignored);
  };
  check_writable(path);
  try {
    write(temporary);
  } catch (const InputError&) {
    discard();
    throw;
  } catch (const std::exception& e) {
    discard();
    throw InputError(path, std::string("could not be written: ") + e.what());
  }
  std::error_code ec;
  fs::rename(temporary, path, ec);
  if (ec) {
    discard();
    throw InputError(path, "could not be written: " + ec.message());
  }
}

void write_file_atomically(const std::string& path, std::span<const std::uint8_t> bytes) {
  write_file_atomically(path, [&](const std::string& temporary) {
    File file(std::fopen(temporary.c_str(), "wb"));
    if (!file) throw InputError(path, std::string("could not be written: ") + std::strerror(errno));
    const bool whole = bytes.empty() || std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size();
    const bool closed = std::fclose(file.release()) == 0;  // a full disk may show only here
    if (!whole || !closed) throw InputError(path, std::string("could not be written: ") + std::strerror(errno));
  });
}

void check_writable(const std::string& path) {
  if (path.empty()) throw InputError("output", "empty file name");
  const fs::path p(path);
  const fs::path folder = p.has_parent_path() ? p.parent_path() : fs::path(".");
  std::error_code ec;
  if (!fs::is_directory(folder, ec)) throw InputError(path, "folder " + folder.string() + " does not exist");
  if (fs::is_directory(p, ec)) throw InputError(path, "is a folder");
  if (fs::exists(p, ec) && !fs::is_regular_file(p, ec)) throw InputError(path, "is not a regular file");
  if (fs::exists(p, ec) && ::access(path.c_str(), W_OK) != 0)
    throw InputError(path, std::string("cannot be overwritten: ") + std::strerror(errno));
  // Trying is the only sure way: permissions, read-only and special file systems all show.
  const std::string temporary = temporary_name(path);
  const bool created = File(std::fopen(temporary.c_str(), "wb")) != nullptr;
  const int error = errno;
  fs::remove(temporary, ec);
  if (!created) throw InputError(path, "folder " + folder.string() + " is not writable: " + std::strerror(error));
}

}  // namespace lightwell
