#include "gpu/pipeline_cache_file.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/files.h"
#include "core/log.h"
#include "lightwell/error.h"

namespace lightwell {

namespace fs = std::filesystem;

namespace {

// Before the driver's bytes: drivers check who wrote them, not whether they are all still there.
struct FileHeader {
  std::array<char, 8> magic{'L', 'W', 'P', 'I', 'P', 'E', '0', '1'};
  std::uint64_t size = 0;
  std::uint64_t hash = 0;
};

// FNV-1a, 64 bits.
std::uint64_t hash_of(std::span<const std::uint8_t> data) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const std::uint8_t byte : data) hash = (hash ^ byte) * 0x100000001b3u;
  return hash;
}

FileHeader header_of(std::span<const std::uint8_t> data) {
  FileHeader header;
  header.size = data.size();
  header.hash = hash_of(data);
  return header;
}

std::string cache_folder() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache && cache[0] == '/') return std::string(cache) + "/lightwell";
  const char* home = std::getenv("HOME");
  return home && home[0] == '/' ? std::string(home) + "/.cache/lightwell" : "";
}

}  // namespace

std::string pipeline_cache_path(const VkPhysicalDeviceProperties& properties) {
  const std::string folder = cache_folder();
  if (folder.empty()) return "";
  std::string name = "pipelines-";
  char digits[16];
  for (const std::uint8_t byte : properties.pipelineCacheUUID) {
    std::snprintf(digits, sizeof digits, "%02x", byte);
    name += digits;
  }
  std::snprintf(digits, sizeof digits, "-%08x", properties.driverVersion);
  return folder + "/" + name + digits;
}

std::vector<std::uint8_t> read_pipeline_data(const std::string& path) {
  std::error_code ec;
  if (path.empty() || !fs::is_regular_file(path, ec)) return {};
  try {
    std::vector<std::uint8_t> bytes = read_file(path);
    FileHeader found;
    if (bytes.size() < sizeof found) return {};
    std::memcpy(&found, bytes.data(), sizeof found);
    bytes.erase(bytes.begin(), bytes.begin() + sizeof found);
    const FileHeader expected = header_of(bytes);
    const bool whole = found.magic == expected.magic && found.size == expected.size && found.hash == expected.hash;
    return whole ? bytes : std::vector<std::uint8_t>{};
  } catch (const InputError&) {
    return {};
  }
}

void write_pipeline_data(const std::string& path, std::span<const std::uint8_t> data) {
  if (data.size() <= sizeof(VkPipelineCacheHeaderVersionOne)) return;
  const FileHeader header = header_of(data);
  std::vector<std::uint8_t> bytes(sizeof header + data.size());
  std::memcpy(bytes.data(), &header, sizeof header);
  std::copy(data.begin(), data.end(), bytes.begin() + sizeof header);
  std::error_code ec;
  fs::create_directories(fs::path(path).parent_path(), ec);
  try {
    write_file_atomically(path, bytes);
  } catch (const InputError& e) {
    log_info(e.what());
  }
}

}  // namespace lightwell
